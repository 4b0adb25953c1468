// Resolves the placement of bodies: no body overlaps another, and robots are pushed out of walls.
//
// Units   metres.
#pragma once

#include <string>
#include <vector>

#include "gsv/base/error.h"
#include "gsv/dynamics/motion/engine.h"

namespace gsv::simulation {

// Returns the position as a text, such as "(1, 2)".
std::string PlaceText(const geometry::Pose& pose);

// A robot that was pushed out of another body. This body is not a robot.
struct PushedOut {
  std::string robot;
  std::string sentence;  // a sentence with the new position and the reason
};

// Resolves the placement of the bodies named `placed`, which are at their initial poses in `state`.
// Two bodies overlap if they penetrate each other by more than a millimetre. A robot that overlaps
// another kind of body is pushed out to the nearest free place, at most its own radius away; this
// changes `state`. If two placed bodies overlap, the first of them in `placed` stays, and the other
// one is treated as above. Fails for the first body for which there is no space.
base::Result<std::vector<PushedOut>> ResolvePlacement(dynamics::Engine& engine,
                                                      const world::Layout& layout,
                                                      const std::vector<std::string>& placed,
                                                      world::State& state);

}  // namespace gsv::simulation
