// The PID controllers of joints (model::JointGains).
//
// Effort  p e + I + c - d v for a position command, and p e + I + c - d dv/dt for a velocity
//         command. Here e is the command minus the measured value, v the joint's velocity, I the
//         integral term and c the offset. The effort is computed with the velocity at the end of a
//         substep, so that large gains on light links stay stable. For a position command, the
//         damping d is at least p times the substep.
// Source  gz::math::PID, whose integral term is limited. Its derivative term acts on the error; the
//         equations above assume a constant command.
#pragma once

#include "gsv/world/state.h"

namespace gsv::dynamics {

// A constraint row on the velocity v of a joint: v + softness * impulse = rate, with an impulse
// (N m s or N s) between two bounds.
struct JointDemand {
  double rate = 0, softness = 0;  // rad/s or m/s; velocity per impulse
  double lower = 0, upper = 0;    // bounds of the impulse
};

// Returns the gains that apply to a command of this kind, or null.
const model::JointGains* GainsFor(const model::Joint& joint, world::JointCommand::Kind kind);

// Returns the constraint row by which a joint at `position` with `velocity` follows its command in
// a substep of `seconds`.
JointDemand DemandOf(const model::Joint& joint, const world::JointCommand& command, double position,
                     double velocity, double integral, double seconds);

// Advances the integral terms of the controllers of all rigid bodies by one step, with the present
// errors of their joints.
void IntegrateErrors(const world::Layout& layout, double step_seconds, world::State& state);

}  // namespace gsv::dynamics
