// What of a world a picture of all of it shows.
#pragma once

#include <vector>

#include "gsv/model/world_description.h"
#include "gsv/world/snapshot.h"

namespace gsv::app {

// The corners, in the world, of the boxes around what stands there and can be seen. Left out are
// planes, which have no end; ground that reaches far beyond all that stands on it; and bodies so far
// away from the others that with them nothing could be made out. A box of 2 m about the origin
// where there is nothing else. Never empty.
std::vector<geometry::Vector3> CornersToShow(const world::Snapshot& snapshot);

// Whether a world is a model alone, as it is read where a world is wanted: beside it there is a
// ground at most.
bool IsModelAlone(const model::WorldDescription& world);
// Puts such a model onto the ground: the origin of a model may be anywhere in it.
void StandModelOnGround(model::WorldDescription& world);

}  // namespace gsv::app
