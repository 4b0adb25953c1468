// The slip of wheels: the velocity at which a wheel's contact slides under a friction force.
//
// Model   slip velocity = friction force * compliance * |rate| * radius / normal force, along the
//         rolling direction and along the axle. It is proportional to the force, as the normal
//         force is a constant of the wheel.
// Source  gz-sim's system WheelSlip. The force is limited by Coulomb friction as well.
#pragma once

#include <optional>

#include "gsv/dynamics/motion/articulation.h"

namespace gsv::dynamics {

struct RollingWheel {
  model::SlippingWheel wheel;
  geometry::Vector3 axle;  // direction of the axle in the part's frame, unit length

  // Slip per friction force, m/(s N), for each rad/s of the wheel; the ground adds its slip.
  double PerRateAlong(const model::Slip& ground) const {
    return (wheel.slip.longitudinal + ground.longitudinal) * wheel.radius / wheel.normal_force;
  }
  double PerRateAcross(const model::Slip& ground) const {
    return (wheel.slip.lateral + ground.lateral) * wheel.radius / wheel.normal_force;
  }
};

// Returns the part as a wheel if one of its links is a wheel (model::Link::wheel), or if the
// model's drive turns it. The wheels of a drive share the weight of the model equally, at a gravity
// in m/s². Null for other parts.
std::optional<RollingWheel> WheelOf(const model::Model& model, const Articulation& articulation,
                                    const Part& part, double gravity);

}  // namespace gsv::dynamics
