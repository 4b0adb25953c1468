// A mesh taken apart: a table's legs and its top, each by itself.
#pragma once

#include <vector>

#include "gsv/geometry/shape.h"

namespace gsv::dynamics {

// The corners (scaled) of each set of triangles that hang together by corners at one place, in the
// order of the triangles. All in one when there are more than `most` sets.
std::vector<std::vector<geometry::Vector3>> ConnectedPieces(const geometry::Mesh& mesh, int most);

}  // namespace gsv::dynamics
