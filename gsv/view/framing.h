// The view of a world that shows everything.
#pragma once

#include <vector>

#include "gsv/rendering/lenses/camera_view.h"
#include "gsv/world/snapshot.h"

namespace gsv::view {

// The corners, in the world, of the boxes around all visible bodies. Left out are infinite planes,
// ground that reaches far beyond the bodies on it, and bodies so far away that the others would be
// too small to see. If nothing is left, a box of 2 m about the origin. Never empty.
std::vector<geometry::Vector3> CornersToShow(const world::Snapshot& snapshot);

// A view from the front, right and above, at the smallest distance that shows all corners.
rendering::CameraView ViewOfAll(const std::vector<geometry::Vector3>& corners, int width,
                                int height);

}  // namespace gsv::view
