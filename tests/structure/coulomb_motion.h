// For tests: the motion of a robot on wheels according to Coulomb's law. It is computed
// independently of the engine, from the robot's contact points, its weight and the speeds of its
// wheels.
//
// Law     a body that is dragged slowly over several points of friction moves such that the power
//         lost to friction is minimal. This power is the sum of friction × load × slip (Peshkin and
//         Sanderson, "Minimization of energy in quasi-static manipulation", IEEE Trans. Robotics
//         and Automation 5 (1989)).
// Loads   a linear function of the contact point's position, such that the loads carry the weight
//         at the centre of mass. Equal springs would have the same loads.
// Frame   the heading frame H: at the model's origin, x along its heading, z up.
#pragma once

#include <optional>
#include <vector>

#include "gsv/dynamics/testing/test_world.h"

namespace gsv {

// The velocity of the model's origin in frame H, in m/s and rad/s.
struct GroundMotion {
  double x = 0, y = 0, turn = 0;
};

// Returns the motion according to the body's state.
GroundMotion MotionOf(const world::BodyState& body);

// Returns the motion according to Coulomb's law. `contacts` are those of the last step, in which
// the body touches only the ground, with a friction of 1. Returns nullopt if it has fewer than
// three contact points, or if all are on one line.
std::optional<GroundMotion> CoulombMotion(const dynamics::testing::TestWorld& world, int body,
                                          const std::vector<world::Contact>& contacts);

}  // namespace gsv
