#include "gsv/simulation/gripping.h"

#include <algorithm>
#include <array>
#include <optional>
#include <set>

namespace gsv::simulation {
namespace {

using geometry::Pose;
using geometry::Vector3;
using world::ActuatorState;
using world::GripperSetup;

const GripperSetup* GripperOf(const ActuatorState& actuator) {
  return std::get_if<GripperSetup>(&actuator.setup->kind);
}

bool IsLoose(const world::Body& body) {
  return !body.is_static && !body.is_robot && !body.is_avatar && body.is_rigid;
}

std::vector<Pose> ModelFromLinks(const world::Body& body, const world::State& state) {
  return world::LinkPoses(*body.model, std::span(state.joint_positions)
                                           .subspan(static_cast<std::size_t>(body.first_joint),
                                                    body.model->joints.size()));
}

// What is between the jaws, and how wide it is.
struct Between {
  int body = -1;
  double width = 0;
};

// Rays across, from where the open jaws are: both find the same thing.
std::optional<Between> FindBetween(const sensing::RayScene& scene, const Pose& world_from_gripper,
                                   const GripperSetup& gripper, int robot,
                                   const world::Layout& layout, const std::set<std::string>& held) {
  constexpr std::array<double, 3> kAlong = {1.0 / 6, 0.5, 5.0 / 6};  // of the jaws' length
  constexpr std::array<double, 3> kUp = {-1.0 / 3, 0, 1.0 / 3};      // of their height
  const auto look = [&](double x, double side, double z) {
    const Vector3 from{x * gripper.reach, side * gripper.opening / 2, z * gripper.height};
    return scene.Cast({world_from_gripper * from,
                       world_from_gripper.orientation * Vector3{0, -side, 0}, gripper.opening},
                      robot);
  };
  std::optional<Between> found;
  for (const double x : kAlong) {
    for (const double z : kUp) {
      const auto left = look(x, 1, z), right = look(x, -1, z);
      if (!left || !right || left->body != right->body) continue;
      const world::Body& body = layout.bodies[static_cast<std::size_t>(left->body)];
      if (!IsLoose(body) || held.contains(body.name)) continue;
      // What reaches beyond a jaw is met from within, on its far side.
      const double width = gripper.opening - left->distance - right->distance;
      if (width > 0 && (!found || width > found->width)) found = Between{left->body, width};
    }
  }
  return found;
}

std::set<std::string> HeldNames(const world::Actuators& actuators) {
  std::set<std::string> names;
  for (const auto& actuator : actuators) {
    if (!actuator->grip.held.empty()) names.insert(actuator->grip.held);
  }
  return names;
}

// The same actuators, `changed` in place of those of its index.
void Replace(std::size_t index, ActuatorState changed, world::State& state) {
  auto actuators = std::make_shared<world::Actuators>(*state.actuators);
  (*actuators)[index] = std::make_shared<const ActuatorState>(std::move(changed));
  state.actuators = std::move(actuators);
}

// The collision shapes of a body, as parts of a link that holds it.
void AddCollisions(const world::Body& held, const world::State& state, const Pose& link_from_held,
                   model::Link& link) {
  const std::vector<Pose> held_from_link = ModelFromLinks(held, state);
  for (std::size_t i = 0; i < held_from_link.size(); ++i) {
    for (model::Collision collision : held.model->links[i].collisions) {
      collision.link_from_collision =
          link_from_held * held_from_link[i] * collision.link_from_collision;
      link.collisions.push_back(std::move(collision));
    }
  }
}

}  // namespace

void CloseJaws(const std::shared_ptr<const world::Snapshot>& now, base::SimTime step,
               sensing::RaySceneCache& rays, base::ThreadTeam* team, world::State& state) {
  if (state.actuators == nullptr) return;
  const world::Layout& layout = *now->layout;
  std::shared_ptr<const sensing::RayScene> scene;  // null until jaws close
  for (std::size_t i = 0; i < state.actuators->size(); ++i) {
    const ActuatorState& actuator = *(*state.actuators)[i];
    const GripperSetup* const gripper = GripperOf(actuator);
    if (gripper == nullptr || world::IsToldToOpen(actuator) || !actuator.grip.held.empty())
      continue;
    if (world::OpeningOf(actuator, state.time) <= 0) continue;  // closed on nothing
    const int robot = layout.Find(actuator.robot);
    if (robot < 0) continue;
    if (scene == nullptr) scene = rays.At(now, team);
    const Pose world_from_link = world::LinkPose(*now, robot, actuator.setup->link);
    const auto between = FindBetween(*scene, world_from_link * actuator.setup->link_from_actuator,
                                     *gripper, robot, layout, HeldNames(*state.actuators));
    if (!between || world::OpeningOf(actuator, state.time + step) > between->width) continue;
    const auto body = static_cast<std::size_t>(between->body);
    ActuatorState holding = actuator;
    holding.grip = {layout.bodies[body].name,
                    Inverse(world_from_link) * state.bodies[body].world_from_model, between->width};
    Replace(i, std::move(holding), state);
  }
}

void LetGo(const world::Layout& layout, const std::vector<std::string>& placed,
           world::State& state) {
  if (state.actuators == nullptr) return;
  for (std::size_t i = 0; i < state.actuators->size(); ++i) {
    const std::string& held = (*state.actuators)[i]->grip.held;
    if (held.empty()) continue;
    const bool is_taken = std::find(placed.begin(), placed.end(), held) != placed.end();
    if (layout.Find(held) >= 0 && !is_taken) continue;
    ActuatorState empty = *(*state.actuators)[i];
    empty.opening_before = world::OpeningOf(empty, state.time);
    empty.since = state.time;
    empty.grip = {};
    Replace(i, std::move(empty), state);
  }
}

void CarryHeld(const world::Layout& layout, base::SimTime time, world::State& state) {
  if (state.actuators == nullptr) return;
  for (const world::ActuatorStatePtr& actuator : *state.actuators) {
    const GripperSetup* const gripper = GripperOf(*actuator);
    const int index = gripper != nullptr ? layout.Find(actuator->robot) : -1;
    if (index < 0) continue;
    const world::Body& robot = layout.bodies[static_cast<std::size_t>(index)];
    for (const std::string* jaw : {&gripper->left_jaw, &gripper->right_jaw}) {
      const int joint =
          jaw->empty() || robot.is_rigid ? -1 : model::FindJoint(robot.model->joints, *jaw);
      if (joint < 0) continue;
      const auto at = static_cast<std::size_t>(robot.first_joint + joint);
      state.joint_positions[at] = (gripper->opening - world::OpeningOf(*actuator, time)) / 2;
    }
    if (actuator->grip.held.empty()) continue;
    const world::BodyState& carrier = state.bodies[static_cast<std::size_t>(index)];
    world::BodyState& held =
        state.bodies[static_cast<std::size_t>(layout.Find(actuator->grip.held))];
    const Pose robot_from_link =
        ModelFromLinks(robot, state)[static_cast<std::size_t>(actuator->setup->link)];
    const Pose before = held.world_from_model;
    held.world_from_model =
        carrier.world_from_model * robot_from_link * actuator->grip.link_from_held;
    const Vector3 arm = held.world_from_model.position - carrier.world_from_model.position;
    held.linear_velocity = carrier.linear_velocity + Cross(carrier.angular_velocity, arm);
    held.angular_velocity = carrier.angular_velocity;
    held.distance += Norm(held.world_from_model.position - before.position);
    held.in_contact = false;
  }
}

std::vector<Hold> HoldsIn(const world::State& state) {
  std::vector<Hold> holds;
  if (state.actuators == nullptr) return holds;
  for (const auto& actuator : *state.actuators) {
    const world::Grip& grip = actuator->grip;
    if (grip.held.empty()) continue;
    holds.push_back({actuator->robot, grip.held, actuator->setup->link, grip.link_from_held});
  }
  return holds;
}

std::shared_ptr<const world::Layout> WithHeld(const std::shared_ptr<const world::Layout>& layout,
                                              const world::State& state) {
  const std::vector<Hold> holds = HoldsIn(state);
  if (holds.empty()) return layout;
  std::vector<world::Body> bodies = layout->bodies;
  const auto change = [](world::Body& body) {
    auto model = std::make_shared<model::Model>(*body.model);
    body.model = model;
    return model;
  };
  for (const Hold& hold : holds) {
    world::Body& robot = bodies[static_cast<std::size_t>(layout->Find(hold.robot))];
    world::Body& held = bodies[static_cast<std::size_t>(layout->Find(hold.held))];
    AddCollisions(held, state, hold.link_from_held,
                  change(robot)->links[static_cast<std::size_t>(hold.link)]);
    for (model::Link& link : change(held)->links) link.collisions.clear();
    held.is_rigid = false;
    held.is_static = true;
  }
  return world::MakeLayout(layout->version, std::move(bodies), layout->description);
}

}  // namespace gsv::simulation
