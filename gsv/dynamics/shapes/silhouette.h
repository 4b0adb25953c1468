// Silhouettes and slices of shapes: the area in the plane that a shape, or its part between two
// heights, covers when seen from above.
//
// Frames  `pose` transforms the shape's frame to a frame whose z axis is up; silhouettes are in the
//         xy plane of that frame.
// Errors  none, because the readers have checked the shapes.
#pragma once

#include <vector>

#include "gsv/dynamics/shapes/convex_piece.h"
#include "gsv/geometry/shape.h"

namespace gsv::dynamics {

// A range of heights, m.
struct Interval {
  double low = 0, high = 0;
  friend bool operator==(const Interval&, const Interval&) = default;
};

// Returns the range of heights of the shape. Not for a Plane.
Interval Heights(const geometry::Shape& shape, const geometry::Pose& pose);

// Returns the area that the shape covers when seen from above; for a mesh, its convex hull. The
// result is exact for boxes, spheres, upright and lying cylinders and capsules, and upright cones.
// For other shapes, it is the smallest polygon around the shape with edges in sixteen directions.
// Not for a Plane.
ConvexPiece Silhouette(const geometry::Shape& shape, const geometry::Pose& pose);

// Adds the area covered by the part of the shape strictly between the two heights. A convex shape
// adds one piece, a mesh (a surface without inside) adds one piece per triangle, and a Plane adds
// none. The piece of an inclined round shape that is cut may be too large by up to 0.5 % of its
// radius.
void Slice(const geometry::Shape& shape, const geometry::Pose& pose, Interval heights,
           std::vector<ConvexPiece>& pieces);

}  // namespace gsv::dynamics
