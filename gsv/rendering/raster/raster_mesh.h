// Triangle meshes for the rasteriser, as a structure of arrays. The vertices of a chunk are
// contiguous. Chunks have coarser levels of detail, for small sizes in the image.
#pragma once

#include <vector>

#include "gsv/rendering/scene/mesh_store.h"

namespace gsv::rendering::raster {

// A chunk in one level of detail. The numbers of vertices and of triangles are multiples of eight:
// copies of the first vertex, and triangles without area, fill the rest.
struct Level {
  float cell = 0;  // largest displacement of a vertex at this level, approximately, m
  std::uint32_t first_vertex = 0, vertex_count = 0;
  std::uint32_t first_triangle = 0, triangle_count = 0;
};

// A triangle mesh with all its levels of detail.
struct RasterMesh final : DrawMesh {
  // The attributes of a vertex in the order of TriangleSurface: 1, u, v, and the normal.
  struct Attributes {
    float values[8];
  };
  // Properties of vertices, one element for each.
  std::vector<float> x, y, z;
  std::vector<Attributes> attributes;
  std::vector<std::uint16_t> surface;
  // Properties of triangles, one element for each. Corners are counted from the first vertex of the
  // level.
  std::vector<std::uint32_t> corners[3];
  // The levels of each chunk; the first level is the finest.
  std::vector<std::vector<Level>> levels;
};

// Makes the mesh and its levels of detail.
std::shared_ptr<const DrawMesh> MakeRasterMesh(MeshArrays arrays);

}  // namespace gsv::rendering::raster
