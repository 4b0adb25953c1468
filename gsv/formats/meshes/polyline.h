// Makes prisms from outlines, for SDFormat's <polyline>.
#pragma once

#include <vector>

#include "gsv/base/error.h"
#include "gsv/geometry/triangle_mesh.h"

namespace gsv::formats {

// The outlines, which are closed and of either sense of rotation, bound an area by the even-odd
// rule: an outline inside another is a hole. The prism over the area goes from z = 0 to `height`.
// Units: metres. Refuses outlines with less than three distinct points or without area, and
// outlines that cross themselves so that they cannot be cut into triangles.
base::Result<geometry::TriangleMesh> ExtrudeOutlines(
    const std::vector<std::vector<geometry::Vector2>>& outlines, double height);

}  // namespace gsv::formats
