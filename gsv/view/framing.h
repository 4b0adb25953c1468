// The view of a world that shows everything.
#pragma once

#include <numbers>
#include <vector>

#include "gsv/rendering/lenses/camera_view.h"
#include "gsv/world/snapshot.h"

namespace gsv::view {

// Returns the corners, in the world, of the boxes around the visible bodies. It omits infinite
// planes, ground that extends far beyond the bodies on it, and bodies so far away that the others
// would be too small to see. If no body remains, returns a box of 2 m about the origin.
std::vector<geometry::Vector3> CornersToShow(const world::Snapshot& snapshot);

// The direction of a view of everything, and how near it is.
struct ViewOfAllSide {
  double azimuth = 0.75 * std::numbers::pi;  // heading of the view, counter-clockwise from x, rad
  double elevation = 0.6;                    // angle by which the view looks down, rad
  double zoom = 1;                           // zoom; with 2 the view is from half the distance
  friend bool operator==(const ViewOfAllSide&, const ViewOfAllSide&) = default;
};

// Returns a view from that side, by default from the front, right and above. Its distance is the
// smallest one that shows all corners, divided by the zoom.
rendering::CameraView ViewOfAll(const std::vector<geometry::Vector3>& corners, int width,
                                int height, const ViewOfAllSide& side = {});

}  // namespace gsv::view
