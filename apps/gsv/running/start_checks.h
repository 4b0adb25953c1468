// Starts of robots and avatars that can be carried out and most likely are not what was meant.
#pragma once

#include <memory>

#include "gsv/base/error.h"
#include "gsv/scenario/scenario.h"
#include "gsv/world/snapshot.h"

namespace gsv::app {

// Warns of a heading beyond a full turn (degrees given as radians), a start far from everything in
// the world, one outside of walls that enclose the rest, and, of rigid bodies, one with nothing
// below. `snapshot` is the world as it is with them; entries without a start are not looked at, nor
// those whose name is not in the world. Each sentence is about one entry.
base::Problems CheckStarts(const std::shared_ptr<const world::Snapshot>& snapshot,
                           const scenario::Scenario& scenario);

}  // namespace gsv::app
