// Makes prisms from outlines, for SDFormat's <polyline>.
#pragma once

#include <vector>

#include "gsv/base/error.h"
#include "gsv/geometry/triangle_mesh.h"

namespace gsv::formats {

// Makes a prism from z = 0 to `height` over the area inside the outlines (metres). Outlines are
// closed, and clockwise or counter-clockwise. The even-odd rule applies: an outline inside another
// is a hole. Fails for outlines with less than three distinct points or without area, and for
// outlines that cannot be triangulated because they cross themselves.
base::Result<geometry::TriangleMesh> ExtrudeOutlines(
    const std::vector<std::vector<geometry::Vector2>>& outlines, double height);

}  // namespace gsv::formats
