// For tests: the motion of a robot on wheels according to Coulomb's law. It is computed
// independently of the engine, from the robot's contact points, its weight and the speeds of its
// wheels.
//
// Law     a body that is dragged slowly over several points of friction moves such that the power
//         lost to friction is minimal. This power is the sum of friction × load × slip (Peshkin and
//         Sanderson, "Minimization of energy in quasi-static manipulation", IEEE Trans. Robotics
//         and Automation 5 (1989)).
// Loads   the load of a contact point is a linear function of its position, such that the loads
//         carry the weight at the centre of mass. Equal springs under the points would have these
//         loads.
//         If all points are on one line, as with a robot that rocks on its two wheels, the function
//         is linear along this line.
// Wheels  a stiff wheel of width w touches the ground with its two edges, which may share its load
//         in any way. The edge with more load rolls, and the other edge slips. If two wheels have
//         the distance B and their outer edges roll, the robot turns at B / (B + w) of the rate of
//         thin wheels. If their inner edges roll, this factor is B / (B - w). If both left edges or
//         both right edges roll, the middle of the robot moves at w / 2 times the rate of the turn.
//         The loads depend on which edges carry. For example, the left wheels stand on their outer
//         edges, and the right wheels on their inner edges. Then the moments about the centre of
//         mass are in balance only if the right wheels carry more load. With four wheels, the robot
//         then turns about a point on the side of the right wheels.
// Balls   a ball in a ball joint rolls in each direction: it carries load without friction.
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

// The motion by Coulomb's law if both edges of each wheel carry load, with the minimum and the
// maximum of each component over all choices of one edge per wheel. Each choice has its own loads.
struct CoulombRange {
  GroundMotion both, min, max;
};

// Returns the motion according to the body's state.
GroundMotion MotionOf(const world::BodyState& body);

// Returns the motion according to Coulomb's law. `contacts` are those of the last step, in which
// the body touches only the ground, with a friction of 1. Returns nullopt if it has fewer than two
// contact points.
std::optional<CoulombRange> CoulombMotion(const dynamics::testing::TestWorld& world, int body,
                                          const std::vector<world::Contact>& contacts);

}  // namespace gsv
