// Splits a mesh into its connected pieces, such as a table's legs and its top.
#pragma once

#include <vector>

#include "gsv/geometry/shape.h"

namespace gsv::dynamics {

// Returns the scaled vertices of each set of triangles that share vertex positions, in the order of
// the triangles. If there are more than `max_pieces` sets, returns one set of all vertices.
std::vector<std::vector<geometry::Vector3>> ConnectedPieces(const geometry::Mesh& mesh,
                                                            int max_pieces);

}  // namespace gsv::dynamics
