// The corners of a box whose edges are parallel to the axes.
#pragma once

#include <array>

#include "gsv/geometry/triangle_mesh.h"

namespace gsv::geometry {

// Returns the corners. Corner i is at the box's maximum x if bit 0 of i is set, at the maximum y if
// bit 1 is set, and at the maximum z if bit 2 is set; else at the minimum.
inline std::array<Vector3, 8> CornersOf(const Bounds& box) {
  std::array<Vector3, 8> corners;
  for (unsigned i = 0; i < corners.size(); ++i) {
    corners[i] = {i & 1 ? box.max.x : box.min.x, i & 2 ? box.max.y : box.min.y,
                  i & 4 ? box.max.z : box.min.z};
  }
  return corners;
}

}  // namespace gsv::geometry
