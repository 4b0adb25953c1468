#include "gsv/rendering/raster/raster_texture.h"

#include <algorithm>
#include <cmath>

namespace gsv::rendering::raster {
namespace {

std::vector<std::uint32_t> Packed(const model::Image& image) {
  std::vector<std::uint32_t> texels;
  const std::size_t count = static_cast<std::size_t>(image.width) * image.height;
  texels.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint8_t* p = &image.pixels[i * image.channels];
    const std::uint32_t alpha = image.channels == 4 ? p[3] : 255;
    texels.push_back(p[0] | p[1] << 8 | p[2] << 16 | alpha << 24);
  }
  return texels;
}

// Appends a level whose texels are the means of two by two texels.
RasterTexture::Level AppendHalf(const RasterTexture::Level& from,
                                std::vector<std::uint32_t>& texels) {
  RasterTexture::Level half{std::max(1, from.width / 2), std::max(1, from.height / 2),
                            static_cast<std::int32_t>(texels.size())};
  for (int y = 0; y < half.height; ++y) {
    for (int x = 0; x < half.width; ++x) {
      std::uint32_t mean = 0;
      for (int shift = 0; shift < 32; shift += 8) {
        std::uint32_t sum = 2;
        for (int k = 0; k < 4; ++k) {
          const int from_x = std::min(2 * x + k % 2, from.width - 1);
          const int from_y = std::min(2 * y + k / 2, from.height - 1);
          const std::size_t at = static_cast<std::size_t>(from.first) +
                                 static_cast<std::size_t>(from_y) * from.width + from_x;
          sum += texels[at] >> shift & 0xff;
        }
        mean |= sum / 4 << shift;
      }
      texels.push_back(mean);
    }
  }
  return half;
}

}  // namespace

std::shared_ptr<DrawTexture> MakeRasterTexture(const model::Image& image) {
  auto texture = std::make_shared<RasterTexture>();
  texture->texels = Packed(image);
  texture->levels.push_back({image.width, image.height, 0});
  while (texture->levels.back().width > 1 || texture->levels.back().height > 1) {
    texture->levels.push_back(AppendHalf(texture->levels.back(), texture->texels));
  }
  return texture;
}

}  // namespace gsv::rendering::raster
