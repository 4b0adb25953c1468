#include "gsv/rendering/raster/raster_texture.h"

#include <algorithm>
#include <cmath>

namespace gsv::rendering::raster {
namespace {

// The texels of a level without its border, row by row.
struct MipLevel {
  int width = 0, height = 0;
  std::vector<std::uint32_t> texels;

  std::uint32_t At(int x, int y) const {
    return texels[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                  static_cast<std::size_t>(x)];
  }
};

MipLevel FinestLevel(const model::Image& image) {
  MipLevel level{image.width, image.height, {}};
  const std::size_t count = static_cast<std::size_t>(image.width) * image.height;
  level.texels.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint8_t* p = &image.pixels[i * image.channels];
    const std::uint32_t alpha = image.channels == 4 ? p[3] : 255;
    level.texels.push_back(p[0] | p[1] << 8 | p[2] << 16 | alpha << 24);
  }
  return level;
}

// Returns the level whose texels are the means of two by two texels.
MipLevel Half(const MipLevel& from) {
  MipLevel half{std::max(1, from.width / 2), std::max(1, from.height / 2), {}};
  half.texels.reserve(static_cast<std::size_t>(half.width) * half.height);
  for (int y = 0; y < half.height; ++y) {
    for (int x = 0; x < half.width; ++x) {
      std::uint32_t mean = 0;
      for (int shift = 0; shift < 32; shift += 8) {
        std::uint32_t sum = 2;
        for (int k = 0; k < 4; ++k) {
          const int from_x = std::min(2 * x + k % 2, from.width - 1);
          const int from_y = std::min(2 * y + k / 2, from.height - 1);
          sum += from.At(from_x, from_y) >> shift & 0xff;
        }
        mean |= sum / 4 << shift;
      }
      half.texels.push_back(mean);
    }
  }
  return half;
}

// Appends a level, with its border, to a texture.
void Append(const MipLevel& level, RasterTexture& texture) {
  const int at = texture.level_count++;
  texture.width[at] = static_cast<float>(level.width);
  texture.height[at] = static_cast<float>(level.height);
  texture.first[at] = static_cast<std::int32_t>(texture.texels.size());
  texture.stride[at] = level.width + 2;
  for (int y = -1; y <= level.height; ++y) {
    const int row = (y + level.height) % level.height;
    texture.texels.push_back(level.At(level.width - 1, row));
    for (int x = 0; x < level.width; ++x) texture.texels.push_back(level.At(x, row));
    texture.texels.push_back(level.At(0, row));
  }
}

}  // namespace

std::shared_ptr<DrawTexture> MakeRasterTexture(const model::Image& image) {
  auto texture = std::make_shared<RasterTexture>();
  MipLevel level = FinestLevel(image);
  Append(level, *texture);
  while ((level.width > 1 || level.height > 1) &&
         texture->level_count < RasterTexture::kMaxLevels) {
    level = Half(level);
    Append(level, *texture);
  }
  return texture;
}

}  // namespace gsv::rendering::raster
