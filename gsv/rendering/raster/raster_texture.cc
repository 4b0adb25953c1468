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
                            texels.size()};
  for (int y = 0; y < half.height; ++y) {
    for (int x = 0; x < half.width; ++x) {
      std::uint32_t mean = 0;
      for (int shift = 0; shift < 32; shift += 8) {
        std::uint32_t sum = 2;
        for (int k = 0; k < 4; ++k) {
          const int from_x = std::min(2 * x + k % 2, from.width - 1);
          const int from_y = std::min(2 * y + k / 2, from.height - 1);
          const std::size_t at =
              from.first + static_cast<std::size_t>(from_y) * from.width + from_x;
          sum += texels[at] >> shift & 0xff;
        }
        mean |= sum / 4 << shift;
      }
      texels.push_back(mean);
    }
  }
  return half;
}

Texels SampleLevel(const RasterTexture& texture, const RasterTexture::Level& level, F8 u, F8 v) {
  const auto axis = [](F8 at, int size, I8& low, I8& high) {
    const F8 extent = Splat(static_cast<float>(size));
    // NaN, which may occur in invisible pixels, becomes the edge of the texture.
    const F8 x =
        Min(Max(Fma(at - Floor(at), extent, Splat(-0.5f)), Splat(-0.5f)), extent - Splat(0.5f));
    const F8 whole = Floor(x);
    const I8 last = SplatInt(size - 1);
    low = Truncated(whole);
    high = SelectInt(low == last, SplatInt(0), low + 1);
    low = SelectInt(low < 0, last, low);
    return x - whole;
  };
  I8 x0, x1, y0, y1;
  const F8 fx = axis(u, level.width, x0, x1), fy = axis(v, level.height, y0, y1);
  const std::uint32_t* texels = &texture.texels[level.first];
  const I8 width = SplatInt(level.width);
  const I8 row0 = y0 * width, row1 = y1 * width;
  I8 t00, t10, t01, t11;
  if (Bits(x1 == x0 + 1) == 0xff) {
    const I8x2 upper = GatherPairs(texels, row0 + x0), lower = GatherPairs(texels, row1 + x0);
    t00 = upper.first, t10 = upper.second, t01 = lower.first, t11 = lower.second;
  } else {  // the texels are at both edges of the texture, which repeats
    t00 = GatherInt(texels, row0 + x0), t10 = GatherInt(texels, row0 + x1);
    t01 = GatherInt(texels, row1 + x0), t11 = GatherInt(texels, row1 + x1);
  }
  const auto channel = [&](int shift) {
    const auto value = [&](I8 t) {
      return ToFloat(
          (I8)_mm256_and_si256(_mm256_srli_epi32((__m256i)t, shift), _mm256_set1_epi32(0xff)));
    };
    const F8 top = Fma(value(t10) - value(t00), fx, value(t00));
    const F8 bottom = Fma(value(t11) - value(t01), fx, value(t01));
    return Fma(bottom - top, fy, top) * Splat(1 / 255.0f);
  };
  return {channel(0), channel(8), channel(16), texture.is_transparent ? channel(24) : Splat(1)};
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

Texels Sample(const RasterTexture& texture, float level, F8 u, F8 v) {
  // Two levels n and n + 1 are blended only if `level` differs from n + 0.5 by less than kBand / 2.
  constexpr float kBand = 0.4f;
  const int most = static_cast<int>(texture.levels.size()) - 1;
  level = std::clamp(level, 0.0f, static_cast<float>(most));
  const int fine = std::min(static_cast<int>(level), most);
  const float share =
      std::clamp((level - static_cast<float>(fine) - 0.5f) / kBand + 0.5f, 0.0f, 1.0f);
  if (share <= 0 || fine == most) return SampleLevel(texture, texture.levels[fine], u, v);
  const Texels b = SampleLevel(texture, texture.levels[fine + 1], u, v);
  if (share >= 1) return b;
  const Texels a = SampleLevel(texture, texture.levels[fine], u, v);
  const F8 k = Splat(share);
  return {Fma(b.r - a.r, k, a.r), Fma(b.g - a.g, k, a.g), Fma(b.b - a.b, k, a.b),
          Fma(b.a - a.a, k, a.a)};
}

}  // namespace gsv::rendering::raster
