// Numbers the surfaces of a mesh: connected parts without a sharp edge, such as the faces of a box
// or the side of a cylinder.
#pragma once

#include <cstdint>
#include <vector>

namespace gsv::rendering {

// `vertices` has 8 floats for each vertex. The first three are the position, and the next three are
// the normal. `indices` has the triangles. Returns a number per vertex. Vertices of one triangle
// have equal numbers. Vertices with equal position and normal also have equal numbers.
std::vector<std::uint32_t> NumberSurfaces(const std::vector<float>& vertices,
                                          const std::vector<std::uint32_t>& indices);

}  // namespace gsv::rendering
