// The slip of wheels: how fast the contact of a wheel slides under a friction force.
//
// Model   slip velocity = friction force * compliance * |rate| * radius / normal force, along the
//         rolling direction and along the axle. It is proportional to the force, as the normal force
//         is a constant of the wheel.
// Source  gz-sim's system WheelSlip. The force is limited by Coulomb friction as well.
#pragma once

#include <optional>

#include "gsv/dynamics/motion/articulation.h"

namespace gsv::dynamics {

struct RollingWheel {
  model::SlippingWheel wheel;
  geometry::Vector3 axle;  // in the part's frame, unit length

  // m/(s N) for each rad/s of the wheel, on ground with a slip of its own.
  double PerRateAlong(const model::Slip& ground) const {
    return (wheel.slip.longitudinal + ground.longitudinal) * wheel.radius / wheel.normal_force;
  }
  double PerRateAcross(const model::Slip& ground) const {
    return (wheel.slip.lateral + ground.lateral) * wheel.radius / wheel.normal_force;
  }
};

// The part as a wheel: one of its links says so (model::Link::wheel), or the model's drive turns it.
// A drive's wheels share the weight of the model in equal parts, at a gravity in m/s². Null for other
// parts.
std::optional<RollingWheel> WheelOf(const model::Model& model, const Articulation& articulation,
                                    const Part& part, double gravity);

}  // namespace gsv::dynamics
