#include "gsv/sensing/devices/logical_camera.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "gsv/geometry/constants.h"
#include "gsv/messages/vision_msgs.h"
#include "gsv/sensing/sensor_type.h"

namespace gsv::sensing {
namespace {

using geometry::Bounds;
using geometry::kInfinity;
using geometry::Pose;
using geometry::Vector3;

// The centre of the box around a model's collisions except planes, with all joints at zero; nullopt
// if the model has no such collisions.
std::optional<Vector3> CentreOf(const model::Model& model) {
  Vector3 low{kInfinity, kInfinity, kInfinity}, high = -low;
  for (const model::Link& link : model.links) {
    for (const model::Collision& collision : link.collisions) {
      if (std::holds_alternative<geometry::Plane>(collision.shape)) continue;
      const Pose model_from_shape = link.model_from_link * collision.link_from_collision;
      const Bounds box = BoundsOf(collision.shape);
      for (int corner = 0; corner < 8; ++corner) {
        const Vector3 p = model_from_shape * Vector3{(corner & 1) != 0 ? box.max.x : box.min.x,
                                                     (corner & 2) != 0 ? box.max.y : box.min.y,
                                                     (corner & 4) != 0 ? box.max.z : box.min.z};
        low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
      }
    }
  }
  if (!(low.x <= high.x)) return std::nullopt;
  return 0.5 * (low + high);
}

class LogicalCamera final
    : public SensorOf<readings::LogicalCamera, messages::vision_msgs::Detection3DArray> {
 public:
  LogicalCamera(const model::SensorDescription& description, ParameterReader& reader)
      : SensorOf(description),
        near_(reader.Number("near", 0.05, 0, 1e4)),
        far_(reader.Number("far", 10, 1e-3, 1e4)),
        frustum_{reader.Number("horizontal_fov", 1.047, 0.01, 3),
                 reader.Number("aspect_ratio", 4.0 / 3, 0.01, 100)},
        half_width_(std::tan(frustum_.horizontal_fov / 2)),
        half_height_(half_width_ / frustum_.aspect_ratio),
        hides_(reader.Flag("occlusion", true)),
        robots_only_(reader.Flag("robots_only", false)) {
    if (near_ > far_) reader.Refuse(fmt::format("near ({}) is larger than far ({})", near_, far_));
  }

  base::Result<Reading> Sample(const Sampling& sampling) const override {
    const world::Snapshot& snapshot = *sampling.snapshot();
    const Pose world_from_sensor = sampling.WorldFromSensor(description());
    const Pose sensor_from_world = Inverse(world_from_sensor);
    Values seen;
    for (int b = 0; b < static_cast<int>(snapshot.layout->bodies.size()); ++b) {
      const world::Body& body = snapshot.layout->bodies[b];
      if (b == sampling.body() || (robots_only_ && !body.is_robot())) continue;
      const auto centre = CentreOf(*body.model);
      if (!centre) continue;
      const Pose& world_from_model = snapshot.state.bodies[b].world_from_model;
      const Vector3 point = world_from_model * *centre;
      if (!IsInFrustum(sensor_from_world * point)) continue;
      if (hides_ && IsHidden(sampling, world_from_sensor.position, point, b)) continue;
      const Pose sensor_from_model = sensor_from_world * world_from_model;
      const Vector3& p = sensor_from_model.position;
      const auto angles = geometry::ToRollPitchYaw(sensor_from_model.orientation);
      seen.sightings.push_back({body.name, {p.x, p.y, p.z, angles.roll, angles.pitch, angles.yaw}});
    }
    Reading reading = sampling.Stamped();
    Fill(seen, reading);
    return reading;
  }

  bool CastsRays() const override { return hides_; }
  std::optional<Frustum> frustum() const override { return frustum_; }

 private:
  Message ToMessage(const Values& seen, const Reading& reading,
                    const std::string& frame_id) const override {
    Message message;
    for (const readings::Sighting& sighting : seen.sightings) {
      const readings::Placement& p = sighting.sensor_from_model;
      const geometry::Quaternion q = geometry::FromRollPitchYaw({p.roll, p.pitch, p.yaw});
      messages::vision_msgs::Detection3D detection;
      detection.header = HeaderOf(reading, frame_id);
      detection.id = sighting.name;
      detection.bbox.center.position = {p.x, p.y, p.z};
      detection.bbox.center.orientation = {q.x, q.y, q.z, q.w};
      message.detections.push_back(std::move(detection));
    }
    return message;
  }

  std::vector<Segment> BeamsOf(const Values& seen) const override {
    std::vector<Segment> lines;
    for (const auto& [name, p] : seen.sightings) lines.push_back({{}, {p.x, p.y, p.z}});
    return lines;
  }

  bool IsInFrustum(const Vector3& point) const {
    return point.x >= near_ && point.x <= far_ && std::abs(point.y) <= half_width_ * point.x &&
           std::abs(point.z) <= half_height_ * point.x;
  }

  static bool IsHidden(const Sampling& sampling, const Vector3& eye, const Vector3& point,
                       int body) {
    const Vector3 sight = point - eye;
    const double distance = Norm(sight);
    const auto hit =
        sampling.Rays().Cast({eye, geometry::Normalized(sight), distance}, sampling.body());
    return hit && hit->body != body;
  }

  const double near_, far_;
  const Frustum frustum_;
  const double half_width_, half_height_;  // of the view at a distance of 1 m, in m
  const bool hides_, robots_only_;
};

}  // namespace

SensorType LogicalCameraType() {
  return MakeSensorType<LogicalCamera>(readings::LogicalCamera::kType, {}, Overlay::kLines);
}

}  // namespace gsv::sensing
