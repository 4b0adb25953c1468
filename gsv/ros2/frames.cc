#include "gsv/ros2/frames.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "gsv/geometry/planar_motion.h"
#include "gsv/presentation/state_messages.h"

namespace gsv::ros2 {
namespace {

using presentation::StampedTransform;

constexpr double kSame = 1e-9;
constexpr std::string_view kBaseLink = "base_link";

bool IsIdentity(const geometry::Pose& pose) {
  const geometry::Vector3& p = pose.position;
  const geometry::Quaternion& q = pose.orientation;
  return std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z), std::abs(q.x), std::abs(q.y),
                   std::abs(q.z)}) < kSame;
}

bool HasLink(const model::Model& model, std::string_view name) {
  return std::any_of(model.links.begin(), model.links.end(),
                     [&](const model::Link& link) { return link.name == name; });
}

std::string_view BaseOf(const model::Model& model) {
  if (IsIdentity(model.links.front().model_from_link)) return model.links.front().name;
  return HasLink(model, kBaseLink) ? "base_footprint" : kBaseLink;
}

}  // namespace

Frames::Frames(std::string prefix, const model::Model& model)
    : prefix_(std::move(prefix)), moving_(world::MovingLinks(model)) {
  base_ = prefix_ + std::string(BaseOf(model));
}

bool Frames::IsMoving(int link) const {
  return std::find(moving_.begin(), moving_.end(), link) != moving_.end();
}

std::string Frames::OfLink(const model::Model& model, int link) const {
  return prefix_ + model.links[static_cast<std::size_t>(link)].name;
}

std::string Frames::OfSensor(const model::Model& model,
                             const model::SensorDescription& sensor) const {
  if (IsIdentity(sensor.link_from_sensor)) return OfLink(model, sensor.link);
  std::string name = prefix_ + sensor.name;
  return HasLink(model, sensor.name) || name == base_ ? name + "_sensor" : name;
}

void Frames::AppendStatic(const model::Model& model,
                          const std::vector<model::SensorDescription>& sensors,
                          const std::vector<bool>& is_optical, base::SimTime time,
                          messages::tf2_msgs::TFMessage& message) const {
  const auto add = [&](const std::string& parent, std::string child, const geometry::Pose& pose) {
    message.transforms.push_back(StampedTransform(parent, std::move(child), time, pose));
  };
  const std::string base_link = prefix_ + std::string(kBaseLink);
  if (base_ != base_link && !HasLink(model, kBaseLink)) add(base_, base_link, {});
  for (std::size_t i = 0; i < model.links.size(); ++i) {
    const int link = static_cast<int>(i);
    std::string frame = OfLink(model, link);
    if (IsMoving(link) || frame == base_) continue;
    add(base_, std::move(frame), model.links[i].model_from_link);
  }
  for (std::size_t i = 0; i < sensors.size(); ++i) {
    const std::string frame = OfSensor(model, sensors[i]);
    const std::string link = OfLink(model, sensors[i].link);
    if (frame != link) add(link, frame, sensors[i].link_from_sensor);
    if (is_optical[i]) {
      const geometry::Pose sensor_from_optical{{}, {0.5, -0.5, 0.5, -0.5}};
      add(frame, sensing::FrameOf(frame, sensing::kOpticalFrame), sensor_from_optical);
    }
  }
}

void Frames::AppendMoving(const world::Snapshot& snapshot, int body, bool has_odometry,
                          messages::tf2_msgs::TFMessage& message) const {
  const world::BodyState& state = snapshot.state.bodies[static_cast<std::size_t>(body)];
  const model::Model& model = *snapshot.layout->bodies[static_cast<std::size_t>(body)].model;
  const base::SimTime time = snapshot.state.time;
  if (has_odometry) {
    message.transforms.push_back(
        StampedTransform(odom(), base_, time, OdometryPose(state.odometry)));
  }
  if (moving_.empty()) return;
  const std::vector<geometry::Pose> links = world::LinkPoses(snapshot, body);
  const geometry::Pose model_from_world = Inverse(state.world_from_model);
  for (const int link : moving_) {
    message.transforms.push_back(
        StampedTransform(base_, OfLink(model, link), time,
                         model_from_world * links[static_cast<std::size_t>(link)]));
  }
}

geometry::Pose OdometryPose(const world::Odometry& odometry) {
  const geometry::PlanarPosition& place = odometry.place;
  return geometry::PlanarPose(place.x, place.y, 0, std::atan2(place.sine, place.cosine));
}

}  // namespace gsv::ros2
