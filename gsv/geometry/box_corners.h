// The corners of a box whose edges are parallel to the axes.
#pragma once

#include <array>

#include "gsv/geometry/triangle_mesh.h"

namespace gsv::geometry {

// Returns the corners. Bits 0, 1 and 2 of a corner's index are for x, y and z: if the bit is set,
// the corner is at the maximum of this coordinate, else at the minimum.
inline std::array<Vector3, 8> CornersOf(const Bounds& box) {
  std::array<Vector3, 8> corners;
  for (unsigned i = 0; i < corners.size(); ++i) {
    corners[i] = {i & 1 ? box.max.x : box.min.x, i & 2 ? box.max.y : box.min.y,
                  i & 4 ? box.max.z : box.min.z};
  }
  return corners;
}

}  // namespace gsv::geometry
