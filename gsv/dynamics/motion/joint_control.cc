#include "gsv/dynamics/motion/joint_control.h"

#include <algorithm>

namespace gsv::dynamics {
namespace {

using Kind = world::JointCommand::Kind;

// As in gz::math::PID, limits have no effect if the minimum exceeds the maximum.
double Limited(double value, const model::Range& range) {
  return range.min <= range.max ? std::clamp(value, range.min, range.max) : value;
}

double ErrorOf(const world::JointCommand& command, double position, double velocity) {
  return command.value - (command.kind == Kind::kPosition ? position : velocity);
}

}  // namespace

const model::JointGains* GainsFor(const model::Joint& joint, Kind kind) {
  if (kind == Kind::kPosition && joint.position_gains) return &*joint.position_gains;
  if (kind == Kind::kVelocity && joint.velocity_gains) return &*joint.velocity_gains;
  return nullptr;
}

JointDemand DemandOf(const model::Joint& joint, const world::JointCommand& command, double position,
                     double velocity, double integral, double seconds) {
  const model::JointGains& gains = *GainsFor(joint, command.kind);
  const double effort = joint.effort_limit;
  JointDemand demand;
  demand.lower = Limited(-effort, gains.effort) * seconds;
  demand.upper = Limited(effort, gains.effort) * seconds;
  // The effort is `push` minus `damping` times the velocity at the end of the substep.
  double push = integral + gains.offset, damping = gains.d;
  if (command.kind == Kind::kPosition) {
    push += gains.p * ErrorOf(command, position, velocity);
    damping = std::max(damping, gains.p * seconds);
  } else {
    damping = gains.p + gains.d / seconds;
    push += gains.p * command.value + gains.d / seconds * velocity;
  }
  if (!(damping > 0)) {
    demand.lower = demand.upper = std::clamp(push * seconds, demand.lower, demand.upper);
    return demand;
  }
  demand.softness = 1 / (damping * seconds);
  demand.rate = push / damping;
  return demand;
}

void IntegrateErrors(const world::Layout& layout, double step_seconds, world::State& state) {
  if (state.joint_commands.empty()) return;
  for (const world::Body& body : layout.bodies) {
    if (!body.is_rigid()) continue;
    for (std::size_t j = 0; j < body.model->joints.size(); ++j) {
      const std::size_t place = static_cast<std::size_t>(body.first_joint) + j;
      const world::JointCommand& command = state.joint_commands[place];
      const model::JointGains* const gains = GainsFor(body.model->joints[j], command.kind);
      if (gains == nullptr || gains->i == 0) continue;
      state.joint_integrals.resize(state.joint_positions.size());
      double& integral = state.joint_integrals[place];
      const double error =
          ErrorOf(command, state.joint_positions[place], state.joint_velocities[place]);
      integral = Limited(integral + gains->i * step_seconds * error, gains->integral);
    }
  }
}

}  // namespace gsv::dynamics
