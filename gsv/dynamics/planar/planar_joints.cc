#include "gsv/dynamics/planar/planar_joints.h"

#include <algorithm>

namespace gsv::dynamics {
namespace {

using Kind = world::JointCommand::Kind;

// Returns the position of a joint after `seconds`.
double Next(const model::Joint& joint, const world::JointCommand& command, double position,
            double seconds) {
  const double most = joint.velocity_limit * seconds;
  double wanted = position;
  if (command.kind == Kind::kPosition) wanted = command.value;
  if (command.kind == Kind::kVelocity) wanted = position + command.value * seconds;
  const double next = position + std::clamp(wanted - position, -most, most);
  return std::clamp(next, joint.position_limits.min, joint.position_limits.max);
}

// Moves the joints that follow others to the positions of their leaders.
void MoveFollowers(const world::Body& body, double seconds, world::State& state) {
  for (std::size_t j = 0; j < body.model->joints.size(); ++j) {
    const model::Joint& joint = body.model->joints[j];
    if (!joint.mimic) continue;
    const auto first = static_cast<std::size_t>(body.first_joint);
    const double leader =
        state.joint_positions[first + static_cast<std::size_t>(joint.mimic->leader)];
    double& position = state.joint_positions[first + j];
    const double before = position;
    const model::Mimic& mimic = *joint.mimic;
    position = std::clamp(mimic.multiplier * (leader - mimic.reference) + mimic.offset,
                          joint.position_limits.min, joint.position_limits.max);
    state.joint_velocities[first + j] = (position - before) / seconds;
  }
}

}  // namespace

void MovePlanarJoints(const world::Layout& layout, double seconds, world::State& state) {
  const bool is_commanded = !state.joint_commands.empty();
  for (const world::Body& body : layout.bodies) {
    if (!body.is_planar()) continue;
    for (std::size_t j = 0; is_commanded && j < body.model->joints.size(); ++j) {
      const auto at = static_cast<std::size_t>(body.first_joint) + j;
      const world::JointCommand& command = state.joint_commands[at];
      if (command.kind == Kind::kNone && state.joint_velocities[at] == 0) continue;
      if (body.model->joints[j].mimic) continue;
      if (world::IsOfDrive(*body.model, static_cast<int>(j))) continue;
      const double before = state.joint_positions[at];
      state.joint_positions[at] = Next(body.model->joints[j], command, before, seconds);
      state.joint_velocities[at] = (state.joint_positions[at] - before) / seconds;
    }
    MoveFollowers(body, seconds, state);
  }
}

}  // namespace gsv::dynamics
