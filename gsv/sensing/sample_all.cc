#include "gsv/sensing/sample_all.h"

#include <algorithm>

#include "gsv/base/check.h"

namespace gsv::sensing {
namespace {

// So many are sampled in one go by a thread.
constexpr std::size_t kSensorsAtOnce = 256;

}  // namespace

void SampleAll(const std::shared_ptr<const world::Snapshot>& snapshot, std::uint64_t seed,
               RaySceneCache& rays, std::span<const SensorAt> sensors, base::ThreadTeam& team,
               std::span<base::Result<Reading>> readings) {
  GSV_CHECK(sensors.size() == readings.size());
  // Made ready here, where the whole team can help, and held until all are done.
  std::shared_ptr<const RayScene> scene;
  if (std::any_of(sensors.begin(), sensors.end(),
                  [](const SensorAt& at) { return at.sensor->CastsRays(); })) {
    scene = rays.At(snapshot, &team);
  }
  team.Share(sensors.size(), kSensorsAtOnce, [&](std::size_t begin, std::size_t end) {
    Sampling sampling(snapshot, sensors[begin].body, seed, rays);
    for (std::size_t i = begin; i < end;) {
      const int body = sensors[i].body;
      const auto last = std::find_if(sensors.begin() + i, sensors.begin() + end,
                                     [&](const SensorAt& at) { return at.body != body; });
      const auto run_end = static_cast<std::size_t>(last - sensors.begin());
      sampling.MoveTo(body);
      sampling.ExpectRays(run_end - i);
      for (; i < run_end; ++i) readings[i] = sensors[i].sensor->Sample(sampling);
    }
  });
}

}  // namespace gsv::sensing
