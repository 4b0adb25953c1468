// Writes triangles as binary STL files, the mesh format that every reader of URDF supports.
//
// Source  "The StL Format" of 3D Systems: 80 octets, a count, and 50 octets per triangle.
#pragma once

#include <cstddef>
#include <string>

#include "gsv/geometry/triangle_mesh.h"

namespace gsv::formats {

// Writes `count` triangles from `first` on, in metres. Coordinates are rounded to single precision.
// Normals of vertices, texture coordinates and materials are left out.
std::string WriteStl(const geometry::TriangleMesh& mesh, std::size_t first, std::size_t count);

}  // namespace gsv::formats
