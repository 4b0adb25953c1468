// Mipmapped textures, and lookups at eight points.
#pragma once

#include <vector>

#include "gsv/rendering/raster/simd.h"
#include "gsv/rendering/scene/texture_store.h"

namespace gsv::rendering::raster {

// A texture and its mipmaps.
struct RasterTexture final : DrawTexture {
  struct Level {
    int width = 0, height = 0;
    std::size_t first = 0;  // index of the level's first texel in `texels`
  };
  std::vector<Level> levels;          // each level is half as large as the one before
  std::vector<std::uint32_t> texels;  // red in the lowest byte, alpha in the highest
};

// Makes the texture of an image, and its mipmaps.
std::shared_ptr<DrawTexture> MakeRasterTexture(const model::Image& image);

// The colours at eight points.
struct Texels {
  F8 r, g, b, a;  // in [0, 1], encoded as in the image
};

// Looks up texels bilinearly, and trilinearly if `level` is about halfway between two levels. u
// points right and v down, and both repeat.
Texels Sample(const RasterTexture& texture, float level, F8 u, F8 v);

}  // namespace gsv::rendering::raster
