// Shapes seen from above: what a shape, or the part of it between two heights, covers of the plane.
//
// Frames  `pose` takes the shape's frame to a frame whose z axis is up; silhouettes are in the xy
//         plane of that frame.
// Errors  none: shapes are those that a reader let through.
#pragma once

#include <vector>

#include "gsv/dynamics/shapes/convex_piece.h"
#include "gsv/geometry/shape.h"

namespace gsv::dynamics {

struct Interval {
  double low = 0, high = 0;
  friend bool operator==(const Interval&, const Interval&) = default;
};

// Heights that the shape reaches. Not for a Plane.
Interval Heights(const geometry::Shape& shape, const geometry::Pose& pose);

// What all of the shape covers; of a mesh, its convex hull. Exact for boxes, spheres, upright and
// lying cylinders and capsules, upright cones; else the smallest polygon around it with edges in
// sixteen directions. Not for a Plane.
ConvexPiece Silhouette(const geometry::Shape& shape, const geometry::Pose& pose);

// Adds what the part of the shape strictly between the two heights covers: one piece for a convex
// shape (at most 0.5 % of its radius too large where a round shape lies askew and is cut), one for
// each triangle of a mesh (its surface: a mesh has no inside). Of a Plane nothing is added.
void Slice(const geometry::Shape& shape, const geometry::Pose& pose, Interval heights,
           std::vector<ConvexPiece>& pieces);

}  // namespace gsv::dynamics
