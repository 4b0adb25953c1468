#include "gsv/sensing/sensor.h"

#include <utility>

#include "gsv/sensing/encoding.h"

namespace gsv::sensing {
namespace {

// For fewer rays, gathering the candidate set takes longer than it saves.
constexpr std::size_t kFewRays = 3;

// The typical distance between the sensors of a robot.
constexpr double kSpread = 0.1;  // m

}  // namespace

void Sampling::MoveTo(int body) {
  body_ = body;
  expected_rays_ = 0;
  has_gathered_ = false;
  link_ = -1;
}

double Sampling::Range(const Ray& ray) const {
  const RayScene& scene = Rays();
  if (has_gathered_ && candidates_->Covers(ray)) return scene.Range(ray, body_, *candidates_);
  if (expected_rays_ < kFewRays) return scene.Range(ray, body_);
  if (candidates_ == nullptr) candidates_ = std::make_unique<CandidateSet>();
  const geometry::Vector3& place = snapshot_->state.bodies[body_].world_from_model.position;
  const double reach = Norm(ray.origin - place) + ray.max_distance + kSpread;
  has_gathered_ = scene.Gather(place, reach, body_, *candidates_);
  // If gathering fails, it is not tried again for the next rays.
  if (!has_gathered_) expected_rays_ = 0;
  return has_gathered_ ? scene.Range(ray, body_, *candidates_) : scene.Range(ray, body_);
}

base::Result<Sensor::Bytes> Sensor::Encode(const Reading& reading,
                                           const std::string& frame_id) const {
  base::Status status;
  Bytes bytes =
      Appended([&](messages::Bytes& out) { status = AppendMessage(reading, frame_id, out); });
  if (!status) return base::Fail(std::move(status.error()));
  return bytes;
}

}  // namespace gsv::sensing
