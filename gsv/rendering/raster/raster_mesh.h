// Triangle meshes as the rasteriser takes them: numbers of one kind side by side, each chunk's
// vertices in one run, coarser copies for where a chunk is small in the picture.
#pragma once

#include <vector>

#include "gsv/rendering/scene/mesh_store.h"

namespace gsv::rendering::raster {

// A chunk in one level of detail. Runs of vertices and triangles have room for whole eights, filled
// up with the run's first vertex and with triangles without an area.
struct Level {
  float cell = 0;  // m in the mesh: no vertex was moved farther than about this
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
