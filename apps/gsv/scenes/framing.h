// The part of a world that an overview image shows.
#pragma once

#include <vector>

#include "gsv/model/world_description.h"
#include "gsv/world/snapshot.h"

namespace gsv::app {

// The corners, in the world, of the boxes around all visible bodies. Left out are infinite planes,
// ground that reaches far beyond the bodies on it, and bodies so far away that the others would be
// too small to see. If nothing is left, a box of 2 m about the origin. Never empty.
std::vector<geometry::Vector3> CornersToShow(const world::Snapshot& snapshot);

// Whether a world is a single model, as it is read if a model is given as a world: it has at most a
// ground besides.
bool IsModelAlone(const model::WorldDescription& world);
// Places such a model on the ground, since the origin of a model may be anywhere in it.
void StandModelOnGround(model::WorldDescription& world);

}  // namespace gsv::app
