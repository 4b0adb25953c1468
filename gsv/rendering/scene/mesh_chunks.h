// Divides a mesh into chunks of neighbouring triangles with one material, so that only the visible
// parts of a building are drawn.
#pragma once

#include <vector>

#include "gsv/geometry/triangle_mesh.h"

namespace gsv::rendering {

// Consecutive elements of MeshChunks::order whose triangles share one material, and the box around
// these triangles.
struct MeshChunk {
  std::uint32_t first_triangle = 0;  // index in `order`
  std::uint32_t triangle_count = 0;
  std::uint32_t material = 0;  // index of the mesh's material slot
  geometry::Bounds bounds;
};

// Every triangle of the mesh occurs once in `order`, in one chunk.
struct MeshChunks {
  std::vector<std::uint32_t> order;  // triangle indices
  std::vector<MeshChunk> chunks;
};

// Cuts a mesh into chunks of at most `max_triangles` triangles.
MeshChunks CutIntoChunks(const geometry::TriangleMesh& mesh, std::uint32_t max_triangles = 512);

}  // namespace gsv::rendering
