// Finds the part of a world that an overview image shows.
#pragma once

#include <vector>

#include "gsv/model/world_description.h"
#include "gsv/world/snapshot.h"

namespace gsv::app {

// Returns the corners, in the world, of the boxes around all visible bodies. It ignores infinite
// planes, ground that reaches far beyond the bodies on it, and bodies so far away that the others
// would be too small to see. If no body remains, it returns a box of 2 m about the origin. Never
// empty.
std::vector<geometry::Vector3> CornersToShow(const world::Snapshot& snapshot);

// Whether a world consists of a single model and at most a ground. A model that is given as a world
// is read so.
bool IsModelAlone(const model::WorldDescription& world);
// Places such a model on the ground, because the origin of a model may be anywhere in it.
void StandModelOnGround(model::WorldDescription& world);

}  // namespace gsv::app
