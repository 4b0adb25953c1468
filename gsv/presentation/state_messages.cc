#include "gsv/presentation/state_messages.h"

#include <algorithm>
#include <cmath>

#include "gsv/messages/time.h"

namespace gsv::presentation {
namespace {

std::uint64_t StepNumber(std::int64_t step) { return static_cast<std::uint64_t>(step); }

// Returns the number of the step at an earlier instant. All steps have the same length.
std::uint64_t StepAt(base::SimTime instant, const world::State& state) {
  if (state.time.count() <= 0) return 0;
  const double part = base::ToSeconds(instant) / base::ToSeconds(state.time);
  return StepNumber(std::llround(static_cast<double>(state.step) * part));
}

messages::geometry_msgs::Transform ToMessage(const geometry::Pose& pose) {
  const geometry::Vector3& p = pose.position;
  const geometry::Quaternion& q = pose.orientation;
  messages::geometry_msgs::Transform message;
  message.translation = {p.x, p.y, p.z};
  message.rotation.x = q.x;
  message.rotation.y = q.y;
  message.rotation.z = q.z;
  message.rotation.w = q.w;
  return message;
}

}  // namespace

messages::geometry_msgs::TransformStamped StampedTransform(
    std::string_view parent, std::string child, base::SimTime time,
    const geometry::Pose& parent_from_child) {
  messages::geometry_msgs::TransformStamped message;
  message.header.stamp = messages::ToMessage(time);
  message.header.frame_id = parent;
  message.child_frame_id = std::move(child);
  message.transform = ToMessage(parent_from_child);
  return message;
}

std::string BodyFrame(const world::Body& body) {
  return body.is_robot() ? FrameOf(body.name, sensing::kBaseFrame) : body.name;
}

std::string LinkFrame(const world::Body& body, const model::Link& link) {
  std::string frame = FrameOf(body.name, link.name);
  return frame == BodyFrame(body) ? frame + "_1" : frame;
}

messages::gsv_msgs::Poses PosesMessage(const world::Snapshot& snapshot,
                                       std::span<const geometry::Pose> poses) {
  messages::gsv_msgs::Poses message;
  message.stamp = messages::ToMessage(snapshot.state.time);
  message.step = StepNumber(snapshot.state.step);
  message.layout_version = snapshot.layout->version;
  message.poses.reserve(7 * poses.size());
  for (const geometry::Pose& pose : poses) {
    const geometry::Vector3& p = pose.position;
    const geometry::Quaternion& q = pose.orientation;
    message.poses.insert(message.poses.end(), {p.x, p.y, p.z, q.x, q.y, q.z, q.w});
  }
  return message;
}

messages::tf2_msgs::TFMessage TransformsMessage(const world::Snapshot& snapshot,
                                                const std::vector<PoseEntry>& list) {
  messages::tf2_msgs::TFMessage message;
  message.transforms.resize(list.size());
  for (std::size_t i = 0; i < list.size(); ++i) {
    const world::Body& body = snapshot.layout->bodies[list[i].body];
    const bool is_body = list[i].link < 0;
    message.transforms[i].header.frame_id = is_body ? sensing::kWorldFrame : BodyFrame(body);
    message.transforms[i].child_frame_id =
        is_body ? BodyFrame(body) : LinkFrame(body, body.model->links[list[i].link]);
  }
  UpdateTransforms(snapshot, list, PosesOf(snapshot, list), message);
  return message;
}

void UpdateTransforms(const world::Snapshot& snapshot, const std::vector<PoseEntry>& list,
                      std::span<const geometry::Pose> poses,
                      messages::tf2_msgs::TFMessage& message) {
  const auto stamp = messages::ToMessage(snapshot.state.time);
  for (std::size_t i = 0; i < list.size(); ++i) {
    const geometry::Pose& world_from_model = snapshot.state.bodies[list[i].body].world_from_model;
    message.transforms[i].header.stamp = stamp;
    message.transforms[i].transform =
        ToMessage(list[i].link < 0 ? poses[i] : Inverse(world_from_model) * poses[i]);
  }
}

messages::gsv_msgs::Contact ContactMessage(const world::Snapshot& snapshot,
                                           const world::Contact& contact) {
  const auto name = [&](int body) {
    return snapshot.layout->bodies[static_cast<std::size_t>(body)].name;
  };
  messages::gsv_msgs::Contact message;
  message.stamp = messages::ToMessage(snapshot.state.time);
  message.step = StepNumber(snapshot.state.step);
  message.first = name(contact.first);
  message.second = name(contact.second);
  message.point = {contact.point.x, contact.point.y, contact.point.z};
  message.normal = {contact.normal.x, contact.normal.y, contact.normal.z};
  message.depth = contact.depth;
  message.closing_speed = contact.closing_speed;
  geometry::Vector3 total;
  for (const world::ContactPoint& at : world::PointsOf(contact)) {
    const geometry::Vector3 force = world::MeanForce(snapshot, at.impulse);
    message.points.push_back({at.point.x, at.point.y, at.point.z});
    message.forces.push_back({force.x, force.y, force.z});
    total += force;
  }
  message.force = {total.x, total.y, total.z};
  return message;
}

messages::gsv_msgs::Contacts ContactsMessage(const world::Snapshot& snapshot) {
  messages::gsv_msgs::Contacts message;
  message.stamp = messages::ToMessage(snapshot.state.time);
  const std::size_t count = std::min(snapshot.contacts.size(), kMaxContacts);
  message.contacts.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    message.contacts.push_back(ContactMessage(snapshot, snapshot.contacts[i]));
  }
  message.left_out = static_cast<std::uint32_t>(snapshot.contacts.size() - count);
  return message;
}

messages::gsv_msgs::Transmission TransmissionMessage(const world::Snapshot& snapshot,
                                                     const world::Transmission& transmission) {
  const world::RadioMessage& sent = *transmission.message;
  messages::gsv_msgs::Transmission message;
  message.stamp = messages::ToMessage(snapshot.state.time);
  message.step = StepNumber(snapshot.state.step);
  message.sender = sent.sender;
  message.radio = sent.radio;
  message.receiver = sent.receiver;
  message.content.assign(sent.content.begin(), sent.content.end());
  message.heard_by = transmission.heard_by;
  return message;
}

messages::gsv_msgs::Command CommandMessage(const std::string& robot, const world::DriveState& drive,
                                           const world::State& state) {
  messages::gsv_msgs::Command message;
  message.stamp = messages::ToMessage(drive.command_time);
  message.step = StepAt(drive.command_time, state);
  message.robot = robot;
  message.linear_m_s = drive.command.linear;
  message.lateral_m_s = drive.command.lateral;
  message.angular_rad_s = drive.command.angular;
  return message;
}

messages::gsv_msgs::ActuatorCommand ActuatorMessage(const world::DeviceState& device,
                                                    const world::State& state) {
  const world::FollowedCommand& followed = *device.followed();
  messages::gsv_msgs::ActuatorCommand message;
  message.stamp = messages::ToMessage(followed.since);
  message.step = StepAt(followed.since, state);
  message.robot = device.robot();
  message.actuator = device.device();
  message.values = followed.command.values;
  message.word = followed.command.word;
  return message;
}

}  // namespace gsv::presentation
