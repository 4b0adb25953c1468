// The slip of wheels: the velocity at which a wheel's contact slides under a friction force.
//
// Model   slip velocity = friction force * compliance * |rate| * radius / normal force, along the
//         rolling direction and along the axle. The slip velocity is proportional to the friction
//         force, because the normal force is a constant of the wheel.
// Source  gz-sim's system WheelSlip. The force is limited by Coulomb friction as well.
#pragma once

#include <optional>

#include "gsv/dynamics/motion/articulation.h"

namespace gsv::dynamics {

// A part that rolls as a wheel.
struct RollingWheel {
  model::SlippingWheel wheel;  // radius, normal force and slip
  geometry::Vector3 axle;      // direction of the axle in the part's frame, unit length

  // Returns the slip velocity along the rolling direction for a friction force of 1 N and a wheel
  // rate of 1 rad/s, in m/s. Includes the slip of the ground.
  double PerRateAlong(const model::Slip& ground) const {
    return (wheel.slip.longitudinal + ground.longitudinal) * wheel.radius / wheel.normal_force;
  }
  // Returns the slip velocity along the axle for the same force and wheel rate, in m/s.
  double PerRateAcross(const model::Slip& ground) const {
    return (wheel.slip.lateral + ground.lateral) * wheel.radius / wheel.normal_force;
  }
};

// Returns the part as a wheel if one of its links is a wheel (model::Link::wheel), or if the
// model's drive rotates it. Returns nullopt for other parts. The wheels of a drive share the
// model's weight equally. `gravity` is in m/s².
std::optional<RollingWheel> WheelOf(const model::Model& model, const Articulation& articulation,
                                    const Part& part, double gravity);

}  // namespace gsv::dynamics
