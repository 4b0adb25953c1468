// A triangle mesh for rendering and collisions.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "gsv/geometry/vector3.h"

namespace gsv::geometry {

// A range of triangles with the same material slot.
struct MeshPart {
  std::string name;                  // the submesh's name in its file; may be empty
  std::uint32_t first_triangle = 0;  // index in TriangleMesh::triangles
  std::uint32_t triangle_count = 0;
  std::uint32_t material = 0;  // index into the visual's materials
};

// Invariants  every index is below positions.size(); normals and texture_coordinates are empty or
//             have the size of positions; parts cover all triangles once, in order; all values
//             finite.
// Winding     counter-clockwise seen from outside.
struct TriangleMesh {
  std::vector<Vector3> positions;                       // metres
  std::vector<Vector3> normals;                         // unit length
  std::vector<Vector2> texture_coordinates;             // (0, 0) is the image's lower left corner
  std::vector<std::array<std::uint32_t, 3>> triangles;  // three indices of vertices each
  std::vector<MeshPart> parts;                          // ranges of triangles by material slot
};

// A box whose edges are parallel to the axes.
struct Bounds {
  Vector3 min, max;  // the smallest and the largest coordinates, m
};

// Returns the bounding box. For a mesh without vertices it is the origin.
Bounds BoundsOf(const TriangleMesh& mesh);

}  // namespace gsv::geometry
