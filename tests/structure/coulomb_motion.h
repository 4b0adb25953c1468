// The motion of a robot on wheels by Coulomb's law, for tests: an independent computation from the
// points at which it stands, its weight and the speeds of its wheels.
//
// Law     a body that is dragged slowly over several points of friction moves so that the power
//         lost to friction is least: sum of friction × load × slip (Peshkin and Sanderson, "Minimization
//         of energy in quasi-static manipulation", IEEE Trans. Robotics and Automation 5 (1989)).
// Loads   a linear function of the point's place that carries the weight at the centre of mass:
//         the points share it as equal springs do.
// Frame   the heading frame H: at the model's origin, x along its heading, z up.
#pragma once

#include <optional>
#include <vector>

#include "gsv/dynamics/testing/test_world.h"

namespace gsv {

// m/s and rad/s, of the model's origin in H.
struct GroundMotion {
  double x = 0, y = 0, turn = 0;
};

// How the body moves now, by its state.
GroundMotion MotionOf(const world::BodyState& body);

// How it moves by Coulomb's law. `contacts` are those of the last step, in which it touches only
// the ground, of friction 1. Nothing if it stands on less than three points, or on one line.
std::optional<GroundMotion> CoulombMotion(const dynamics::testing::TestWorld& world, int body,
                                          const std::vector<world::Contact>& contacts);

}  // namespace gsv
