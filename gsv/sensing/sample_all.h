// Many sensors at one instant.
#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "gsv/base/thread_team.h"
#include "gsv/sensing/sensor.h"

namespace gsv::sensing {

// A sensor on the body of that index in the layout.
struct SensorAt {
  const Sensor* sensor = nullptr;
  int body = -1;
};

// Samples each sensor, shared out over the team; readings[i] is that of sensors[i]. It is quickest
// when the sensors of a robot stand in a row. The same to the bit for any number of threads, and
// the same as Sensor::Sample() one by one.
void SampleAll(const std::shared_ptr<const world::Snapshot>& snapshot, std::uint64_t seed,
               RaySceneCache& rays, std::span<const SensorAt> sensors, base::ThreadTeam& team,
               std::span<base::Result<Reading>> readings);

}  // namespace gsv::sensing
