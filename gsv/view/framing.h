// Computes a view that shows the whole world.
#pragma once

#include <numbers>
#include <vector>

#include "gsv/rendering/lenses/camera_view.h"
#include "gsv/world/snapshot.h"

namespace gsv::view {

// Returns the corners, in the world, of the boxes around the visible bodies. It omits infinite
// planes, ground that extends far beyond the bodies on it, and very distant bodies: with them in
// view, the other bodies would be too small to see. If no body remains, returns two corners of a
// box of 2 m x 2 m x 1 m on the origin.
std::vector<geometry::Vector3> CornersToShow(const world::Snapshot& snapshot);

// The direction of a view of the whole world, and its zoom.
struct OverviewSide {
  double azimuth = 0.75 * std::numbers::pi;  // heading of the view, counter-clockwise from x, rad
  double elevation = 0.6;                    // angle by which the view looks down, rad
  double zoom = 1;                           // zoom; 2 means half the distance
  friend bool operator==(const OverviewSide&, const OverviewSide&) = default;
};

// Returns the view of these corners from `side` (default: from the front, right and above). The
// camera's distance is the smallest distance at which all corners are visible, divided by the zoom.
rendering::CameraView Overview(const std::vector<geometry::Vector3>& corners, int width, int height,
                               const OverviewSide& side = {});

}  // namespace gsv::view
