// Resolves the placement of bodies: none overlaps another, and robots are pushed out of walls.
//
// Units   metres.
#pragma once

#include <string>
#include <vector>

#include "gsv/base/error.h"
#include "gsv/dynamics/motion/engine.h"

namespace gsv::simulation {

// The position as a text: "(1, 2)".
std::string PlaceText(const geometry::Pose& pose);

// A robot that was pushed out of a body that is not a robot.
struct PushedOut {
  std::string robot;
  std::string sentence;  // the resolved position, and the reason
};

// Resolves the placement of the bodies named `placed`, which are at their initial poses in `state`.
// Two bodies overlap if their penetration exceeds a millimetre. A robot that overlaps a body other
// than a robot is pushed out to the nearest free place, at most its own radius away, and `state` is
// updated. If two placed bodies overlap, the second is refused. Fails for the first body without
// room.
base::Result<std::vector<PushedOut>> ResolvePlacement(dynamics::Engine& engine,
                                                      const world::Layout& layout,
                                                      const std::vector<std::string>& placed,
                                                      world::State& state);

}  // namespace gsv::simulation
