// Cuts polygons with holes into triangles.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "gsv/base/error.h"
#include "gsv/geometry/vector3.h"

namespace gsv::formats {

using Outline = std::vector<geometry::Vector2>;

// Twice the area; positive when counter-clockwise.
double TwiceSignedArea(const Outline& outline);

// Ear clipping, holes joined to the outer outline by bridges (D. Eberly, "Triangulation by Ear
// Clipping"). `outer` runs counter-clockwise and each hole clockwise, inside it; none crosses
// itself or another. Triangles are counter-clockwise; their corners index the points of outer, then
// of holes[0], and so on. Quadratic in the number of points.
base::Result<std::vector<std::array<std::uint32_t, 3>>> Triangulate(
    const Outline& outer, const std::vector<Outline>& holes);

}  // namespace gsv::formats
