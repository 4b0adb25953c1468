#include "gsv/sensing/devices/gripper_state.h"

#include <algorithm>
#include <array>
#include <set>
#include <utility>

#include "gsv/sensing/devices/link_motion.h"

namespace gsv::sensing {
namespace {

using geometry::Pose;
using geometry::Vector3;

bool Opens(const world::DeviceCommand& command) {
  return command.values.empty() || command.values[0] > 0.5;
}

bool CanBeGrasped(const world::Body& body) { return body.is_rigid() && !body.is_robot(); }

std::set<std::string> HeldBodies(const world::State& state) {
  std::set<std::string> names;
  for (const world::DeviceStatePtr& device : *state.devices) {
    if (const world::Grasp* const grasp = device->grasp()) names.insert(grasp->held);
  }
  return names;
}

// The body between the fingers, and its width.
struct Between {
  int body = -1;
  double width = 0;
};

// Casts rays across the opening from both open fingers. Both rays must hit the same body.
std::optional<Between> FindBetween(const world::DeviceStep& step, const Pose& world_from_gripper,
                                   const GripperSetup& gripper, int robot) {
  // positions of the rays, as fractions of the fingers' length
  constexpr std::array<double, 3> kAlong = {1.0 / 6, 0.5, 5.0 / 6};
  // heights of the rays, as fractions of the fingers' height
  constexpr std::array<double, 3> kUp = {-1.0 / 3, 0, 1.0 / 3};
  const auto cast = [&](double x, double side, double z) {
    const Vector3 from{x * gripper.reach, side * gripper.opening / 2, z * gripper.height};
    return step.rays.Cast({world_from_gripper * from,
                           world_from_gripper.orientation * Vector3{0, -side, 0}, gripper.opening},
                          robot);
  };
  const std::set<std::string> held = HeldBodies(step.state);
  std::optional<Between> found;
  for (const double x : kAlong) {
    for (const double z : kUp) {
      const auto left = cast(x, 1, z), right = cast(x, -1, z);
      if (!left || !right || left->body != right->body) continue;
      const world::Body& body = step.now->layout->bodies[static_cast<std::size_t>(left->body)];
      if (!CanBeGrasped(body) || held.contains(body.name)) continue;
      // If the body extends beyond a finger, the ray of this finger starts inside the body and hits
      // the far side of the body. The computed width is then not positive, and the body is not
      // grasped.
      const double width = gripper.opening - left->distance - right->distance;
      if (width > 0 && (!found || width > found->width)) found = Between{left->body, width};
    }
  }
  return found;
}

}  // namespace

GripperState::GripperState(world::DeviceMount mount, world::FollowedCommand followed,
                           GripperSetupPtr setup, double opening_before, std::optional<Hold> hold)
    : ActuatorState(std::move(mount), std::move(followed)),
      setup_(std::move(setup)),
      opening_before_(opening_before),
      hold_(std::move(hold)) {}

std::shared_ptr<const GripperState> GripperState::After(const world::DeviceState* before,
                                                        world::DeviceMount mount,
                                                        world::FollowedCommand followed,
                                                        GripperSetupPtr setup) {
  const auto* const gripper = dynamic_cast<const GripperState*>(before);
  const double opening = gripper != nullptr ? gripper->OpeningAt(followed.since) : setup->opening;
  std::optional<Hold> hold;
  if (gripper != nullptr && !Opens(followed.command)) hold = gripper->hold_;
  return std::make_shared<const GripperState>(std::move(mount), std::move(followed),
                                              std::move(setup), opening, std::move(hold));
}

bool GripperState::opens() const { return Opens(followed()->command); }

double GripperState::OpeningAt(base::SimTime now) const {
  const double wanted = opens() ? setup_->opening : 0;
  const double way = setup_->opening * base::ToSeconds(now - since()) / setup_->closing_time;
  const double opening = opening_before_ + std::clamp(wanted - opening_before_, -way, way);
  return hold_ ? std::max(opening, hold_->width) : opening;
}

void GripperState::AddRestToHash(base::Hash& hash) const {
  AddGraspToHash(opening_before_, hold_ ? hold_->grasp : world::Grasp(), hold_ ? hold_->width : 0,
                 hash);
}

world::DeviceStatePtr GripperState::BeforeStep(world::DeviceStep& step) const {
  if (opens() || hold_) return nullptr;
  const base::SimTime time = step.state.time;
  if (OpeningAt(time) <= 0) return nullptr;  // the fingers have closed, and nothing is between them
  const int index = step.now->layout->Find(robot());
  if (index < 0) return nullptr;
  const Pose world_from_link = world::LinkPose(*step.now, index, mount().link);
  const auto between =
      FindBetween(step, world_from_link * mount().link_from_device, *setup_, index);
  if (!between || OpeningAt(time + step.length) > between->width) return nullptr;
  const auto body = static_cast<std::size_t>(between->body);
  Hold hold{{step.now->layout->bodies[body].name,
             Inverse(world_from_link) * step.state.bodies[body].world_from_model},
            between->width};
  return std::make_shared<const GripperState>(mount(), *followed(), setup_, opening_before_,
                                              std::move(hold));
}

world::DeviceStatePtr GripperState::CarryOver(const world::Layout& layout,
                                              const std::vector<std::string>& placed,
                                              base::SimTime now) const {
  if (!hold_) return nullptr;
  const std::string& held = hold_->grasp.held;
  const bool is_placed = std::find(placed.begin(), placed.end(), held) != placed.end();
  if (layout.Find(held) >= 0 && !is_placed) return nullptr;
  return std::make_shared<const GripperState>(
      mount(), world::FollowedCommand{followed()->command, now}, setup_, OpeningAt(now));
}

void GripperState::AfterMove(const world::Layout& layout, base::SimTime time,
                             world::State& state) const {
  const int index = layout.Find(robot());
  if (index < 0) return;
  MoveFingers(layout.bodies[static_cast<std::size_t>(index)], time, state);
  if (hold_) MoveAttachedBody(layout, index, state);
}

void GripperState::MoveFingers(const world::Body& robot, base::SimTime time,
                               world::State& state) const {
  if (robot.is_rigid()) return;
  for (const std::string* jaw : {&setup_->left_finger, &setup_->right_finger}) {
    const int joint = jaw->empty() ? -1 : model::FindJoint(robot.model->joints, *jaw);
    if (joint < 0) continue;
    state.joint_positions[static_cast<std::size_t>(robot.first_joint + joint)] =
        (setup_->opening - OpeningAt(time)) / 2;
  }
}

void GripperState::MoveAttachedBody(const world::Layout& layout, int robot,
                                    world::State& state) const {
  world::BodyState& held = state.bodies[static_cast<std::size_t>(layout.Find(hold_->grasp.held))];
  const Pose before = held.world_from_model;
  LinkMotion motion = MotionOfLink(layout, state, robot, mount().link);
  held.world_from_model = motion.world_from_link * hold_->grasp.link_from_held;
  motion.MoveTo(held.world_from_model.position);
  held.linear_velocity = motion.velocity;
  held.angular_velocity = motion.angular_velocity;
  held.distance += Norm(held.world_from_model.position - before.position);
  held.in_contact = false;
}

}  // namespace gsv::sensing
