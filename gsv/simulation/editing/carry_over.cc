#include "gsv/simulation/editing/carry_over.h"

#include <algorithm>

namespace gsv::simulation {
namespace {

void CarryBody(const world::Layout& old_layout, const world::State& old_state, int old,
               const world::Layout& layout, int now, world::State& state) {
  const world::Body& body = layout.bodies[static_cast<std::size_t>(now)];
  const world::Body& old_body = old_layout.bodies[static_cast<std::size_t>(old)];
  state.bodies[static_cast<std::size_t>(now)] = old_state.bodies[static_cast<std::size_t>(old)];
  const auto carry = [&](const auto& from, auto& to) {
    std::copy_n(from.begin() + old_body.first_joint, body.model->joints.size(),
                to.begin() + body.first_joint);
  };
  carry(old_state.joint_positions, state.joint_positions);
  carry(old_state.joint_velocities, state.joint_velocities);
  if (!state.goals.empty() && !old_state.goals.empty()) {
    state.goals[static_cast<std::size_t>(now)] = old_state.goals[static_cast<std::size_t>(old)];
  }
  if (!old_state.joint_integrals.empty()) {
    state.joint_integrals.resize(static_cast<std::size_t>(layout.joint_count));
    carry(old_state.joint_integrals, state.joint_integrals);
  }
  if (old_state.joint_commands.empty()) return;
  state.joint_commands.resize(static_cast<std::size_t>(layout.joint_count));
  carry(old_state.joint_commands, state.joint_commands);
}

}  // namespace

world::State CarryOver(const world::Layout& old_layout, const world::State& old_state,
                       const world::Layout& layout) {
  world::State state = world::InitialState(layout);
  state.step = old_state.step;
  state.time = old_state.time;
  for (int i = 0; i < static_cast<int>(layout.bodies.size()); ++i) {
    const int old = old_layout.Find(layout.bodies[static_cast<std::size_t>(i)].name);
    if (old >= 0) CarryBody(old_layout, old_state, old, layout, i, state);
  }
  state.devices = old_state.devices;
  return state;
}

void ResetToInitialPose(const world::Layout& layout, int body, world::State& state) {
  const world::Body& placed = layout.bodies[static_cast<std::size_t>(body)];
  world::BodyState& now = state.bodies[static_cast<std::size_t>(body)];
  now.world_from_model = placed.initial_pose;
  now.linear_velocity = now.angular_velocity = {};
  now.drive.actual = {};
  now.in_contact = false;
  std::fill_n(state.joint_velocities.begin() + placed.first_joint, placed.model->joints.size(),
              0.0);
}

}  // namespace gsv::simulation
