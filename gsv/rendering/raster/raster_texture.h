// Mipmapped textures, and lookups at eight points.
#pragma once

#include <vector>

#include "gsv/rendering/raster/simd.h"
#include "gsv/rendering/scene/texture_store.h"

namespace gsv::rendering::raster {

struct RasterTexture final : DrawTexture {
  struct Level {
    int width = 0, height = 0;
    std::size_t first = 0;
  };
  std::vector<Level> levels;          // each half as large as the one before
  std::vector<std::uint32_t> texels;  // red in the lowest byte, alpha in the highest
};

std::shared_ptr<DrawTexture> MakeRasterTexture(const model::Image& image);

struct Texels {
  F8 r, g, b, a;  // [0, 1], encoded as the image
};

// Bilinear lookup; trilinear if `level` is about halfway between two levels. u to the right and v
// downwards, repeating.
Texels Sample(const RasterTexture& texture, float level, F8 u, F8 v);

}  // namespace gsv::rendering::raster
