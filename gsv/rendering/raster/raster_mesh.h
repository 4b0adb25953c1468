// Triangle meshes for the rasteriser: a structure of arrays, with contiguous vertices per chunk and
// coarser levels of detail for chunks that are small in the image.
#pragma once

#include <vector>

#include "gsv/rendering/scene/mesh_store.h"

namespace gsv::rendering::raster {

// A chunk in one level of detail. Runs of vertices and triangles are padded to multiples of eight,
// with the first vertex and with degenerate triangles.
struct Level {
  float cell = 0;  // m in the mesh: the largest displacement of a vertex, approximately
  std::uint32_t first_vertex = 0, vertex_count = 0;
  std::uint32_t first_triangle = 0, triangle_count = 0;
};

struct RasterMesh final : DrawMesh {
  // Of each vertex.
  std::vector<float> x, y, z, normal_x, normal_y, normal_z, u, v;
  std::vector<std::uint16_t> surface;
  // Of each triangle, counted from its level's first vertex.
  std::vector<std::uint32_t> corners[3];
  // Of each chunk, finest first.
  std::vector<std::vector<Level>> levels;
};

std::shared_ptr<const DrawMesh> MakeRasterMesh(MeshArrays arrays);

}  // namespace gsv::rendering::raster
