// Combines the tiled textures of SDFormat's <heightmap> into one image for the whole terrain.
#pragma once

#include <memory>
#include <vector>

#include "gsv/geometry/triangle_mesh.h"
#include "gsv/model/image.h"

namespace gsv::formats {

// A texture that covers the terrain in tiles.
struct TerrainLayer {
  std::shared_ptr<const model::Image> image;  // null: uniform grey
  double tile = 10;                           // side of a tile, m
  // The layer covers the earlier layers from the height `min_height` upwards. Its opacity grows
  // from 0 to 1 over the next `fade_distance`. Both are ignored for the first layer.
  double min_height = 0, fade_distance = 0;  // m
};

// Maximum number of pixels per side.
inline constexpr int kTerrainTextureSide = 1024;

// Returns the texture for a mesh of HeightmapMesh() with `size.x` by `size.y` metres. The first
// tile of a layer begins at the terrain's lower left corner. If the pixels of a layer are smaller
// than the pixels of the result, a pixel of the result is the mean of the area that it covers.
// `layers` must not be empty.
model::Image TerrainTexture(const geometry::TriangleMesh& mesh, geometry::Vector2 size,
                            const std::vector<TerrainLayer>& layers);

}  // namespace gsv::formats
