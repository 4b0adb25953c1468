// Where bodies may be placed: none inside another, robots beside a wall instead of in it.
//
// Units   metres.
#pragma once

#include <string>
#include <vector>

#include "gsv/base/error.h"
#include "gsv/dynamics/motion/engine.h"

namespace gsv::simulation {

// "(1, 2)": x and y.
std::string PlaceText(const geometry::Pose& pose);

// A robot that was pushed out of something that is no robot.
struct PushedOut {
  std::string robot;
  std::string sentence;  // where it starts instead, and why
};

// Finds room for the bodies named `placed`, which stand at their initial poses in `state`. Two
// bodies overlap if they are closer than touching by more than a millimetre. A robot that overlaps
// something that is no robot is pushed out to the nearest free place, its own radius away at most,
// and `state` says where. Of two newcomers at one place the second is refused. Fails with the
// first of the bodies that there is no room for.
base::Result<std::vector<PushedOut>> ResolvePlacement(dynamics::Engine& engine,
                                                      const world::Layout& layout,
                                                      const std::vector<std::string>& placed,
                                                      world::State& state);

}  // namespace gsv::simulation
