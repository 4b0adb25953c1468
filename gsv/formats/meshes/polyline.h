// Prisms over outlines, as SDFormat's <polyline> describes them.
#pragma once

#include <vector>

#include "gsv/base/error.h"
#include "gsv/geometry/triangle_mesh.h"

namespace gsv::formats {

// The outlines, each closed by itself and of either sense of rotation, bound an area by the
// even-odd rule: an outline inside another is a hole. The prism over it runs from z = 0 to
// `height`. Units: metres. Refuses outlines with less than three distinct points, without area, or
// that cannot be cut into triangles because they cross themselves.
base::Result<geometry::TriangleMesh> ExtrudeOutlines(
    const std::vector<std::vector<geometry::Vector2>>& outlines, double height);

}  // namespace gsv::formats
