// Splits a mesh into its connected pieces, such as a table's legs and its top.
#pragma once

#include <vector>

#include "gsv/geometry/shape.h"

namespace gsv::dynamics {

// Two triangles belong to one piece if they have a vertex at the same position, or if a chain of
// such triangles connects them. Returns the scaled vertices of each piece, in the order of the
// mesh's triangles. If there are more than `max_pieces` pieces, returns all vertices as one piece.
std::vector<std::vector<geometry::Vector3>> ConnectedPieces(const geometry::Mesh& mesh,
                                                            int max_pieces);

}  // namespace gsv::dynamics
