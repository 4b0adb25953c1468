// Numbers the surfaces of a mesh: pieces that hang together without a sharp edge, such as each face
// of a box, or the side of a cylinder.
#pragma once

#include <cstdint>
#include <vector>

namespace gsv::rendering {

// `vertices` holds 8 floats each, of which the first three are the position and the next three the
// normal; `indices` holds triangles. Gives one number for each vertex: vertices of one triangle,
// and those that share position and normal, have the same.
std::vector<std::uint32_t> NumberSurfaces(const std::vector<float>& vertices,
                                          const std::vector<std::uint32_t>& indices);

}  // namespace gsv::rendering
