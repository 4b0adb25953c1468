// Warns about start poses of robots and avatars that are valid, but probably a mistake.
#pragma once

#include <memory>

#include "gsv/base/error.h"
#include "gsv/scenario/scenario.h"
#include "gsv/world/snapshot.h"

namespace gsv::app {

// Warns of a heading of more than 2 pi, which was probably given in degrees, and of a start far
// from all bodies of the world. Also warns of a start outside the walls that enclose the world, and
// of a robot under rigid-body dynamics without ground below it. `snapshot` is the world with the
// robots. Ignores entries without a start. Checks only the heading of entries whose name is not in
// the world, and of entries after the first 200. Each sentence is about one entry.
base::Problems CheckStarts(const std::shared_ptr<const world::Snapshot>& snapshot,
                           const scenario::Scenario& scenario);

}  // namespace gsv::app
