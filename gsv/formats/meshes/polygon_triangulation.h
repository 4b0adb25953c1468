// Triangulates polygons with holes.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "gsv/base/error.h"
#include "gsv/geometry/vector3.h"

namespace gsv::formats {

using Outline = std::vector<geometry::Vector2>;

// Returns twice the area; positive if the outline is counter-clockwise.
double TwiceSignedArea(const Outline& outline);

// Cuts a polygon into triangles by ear clipping. Bridges join the holes to the outer outline (D.
// Eberly, "Triangulation by Ear Clipping"). `outer` must be counter-clockwise, and each hole
// clockwise and inside it. No outline may cross itself or another. Triangles are counter-clockwise;
// their corners index the points of outer, then of holes[0], and so on. Quadratic time.
base::Result<std::vector<std::array<std::uint32_t, 3>>> Triangulate(
    const Outline& outer, const std::vector<Outline>& holes);

}  // namespace gsv::formats
