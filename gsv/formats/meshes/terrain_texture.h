// One image for a whole terrain, put together from the tiled textures of SDFormat's <heightmap>.
#pragma once

#include <memory>
#include <vector>

#include "gsv/geometry/triangle_mesh.h"
#include "gsv/model/image.h"

namespace gsv::formats {

// A texture that covers the terrain in tiles.
struct TerrainLayer {
  std::shared_ptr<const model::Image> image;  // null: an even grey
  double tile = 10;                           // m: a tile's side
  // It covers the layers before it from this height upwards, evenly more of them over a distance.
  // Of the first layer both are ignored.
  double min_height = 0, fade_distance = 0;  // m
};

// Pixels a side, at most.
inline constexpr int kTerrainTextureSide = 1024;

// The layers over a mesh of HeightmapMesh() that is `size.x` by `size.y` metres, as its texture
// coordinates want it. A tile's lower left corner lies in that of the terrain. Where tiles are finer
// than the image, each pixel is the mean of what it covers. `layers` must not be empty.
model::Image TerrainTexture(const geometry::TriangleMesh& mesh, geometry::Vector2 size,
                            const std::vector<TerrainLayer>& layers);

}  // namespace gsv::formats
