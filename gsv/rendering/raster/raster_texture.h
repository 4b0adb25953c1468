// Mipmapped textures, and lookups at eight points.
#pragma once

#include <algorithm>
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

// The colours at the points of a vector.
template <class F>
struct Texels {
  F r, g, b, a;  // in [0, 1], encoded as in the image
};

// The levels of detail of a look-up. Each group of eight lanes has its own.
template <class F>
struct MipLevels {
  static constexpr int kGroups = Lanes<F>::kCount / 8;
  int fine[kGroups];     // a level of the texture
  float share[kGroups];  // the share of the next level, from 0 to less than 1

  // Two levels n and n + 1 are blended only if `level` is about halfway between them.
  MipLevels(const RasterTexture& texture, const float (&level)[kGroups]) {
    // The width of the range about n + 0.5 in which two levels are blended.
    constexpr float kBand = 0.4f;
    const int last_level = static_cast<int>(texture.levels.size()) - 1;
    for (int i = 0; i < kGroups; ++i) {
      // NaN becomes 0.
      const float within = level[i] > 0 ? std::min(level[i], static_cast<float>(last_level)) : 0.0f;
      fine[i] = static_cast<int>(within);
      share[i] =
          std::clamp((within - static_cast<float>(fine[i]) - 0.5f) / kBand + 0.5f, 0.0f, 1.0f);
      if (fine[i] == last_level) share[i] = 0;
      if (share[i] == 1) ++fine[i], share[i] = 0;
    }
  }
};

// Looks up texels bilinearly in one level for each group of eight lanes. u points right and v down,
// from 0 to 1.
template <class F>
Texels<F> SampleLevels(const RasterTexture& texture, const int (&levels)[MipLevels<F>::kGroups],
                       F u, F v) {
  using Ints = typename Lanes<F>::Ints;
  constexpr int kGroups = MipLevels<F>::kGroups;
  int widths[kGroups], heights[kGroups], firsts[kGroups];
  for (int i = 0; i < kGroups; ++i) {
    const RasterTexture::Level& level = texture.levels[static_cast<std::size_t>(levels[i])];
    widths[i] = level.width, heights[i] = level.height;
    firsts[i] = static_cast<int>(level.first);
  }
  const Ints width = ByGroup(widths), height = ByGroup(heights);
  const auto axis = [](F at, Ints size, Ints& low, Ints& high) {
    const F extent = ToFloat(size);
    // NaN, which may occur in invisible pixels, becomes the edge of the texture.
    const F x =
        Min(Max(Fma(at, extent, Splat<F>(-0.5f)), Splat<F>(-0.5f)), extent - Splat<F>(0.5f));
    const F whole = Floor(x);
    const Ints last = size - 1;
    low = Truncated(whole);
    high = SelectInt(EqualInt(low, last), SplatInt<F>(0), low + 1);
    low = SelectInt(LessInt(low, SplatInt<F>(0)), last, low);
    return x - whole;
  };
  Ints x0, x1, y0, y1;
  const F fx = axis(u, width, x0, x1), fy = axis(v, height, y0, y1);
  const std::uint32_t* texels = texture.texels.data();
  const Ints first = ByGroup(firsts);
  const Ints row0 = y0 * width + first, row1 = y1 * width + first;
  Ints t00, t10, t01, t11;
  if (Bits(EqualInt(x1, x0 + 1)) == (1 << Lanes<F>::kCount) - 1) {
    const auto upper = GatherPairs(texels, row0 + x0), lower = GatherPairs(texels, row1 + x0);
    t00 = upper.first, t10 = upper.second, t01 = lower.first, t11 = lower.second;
  } else {  // some texels are at both edges of the texture, which repeats
    t00 = GatherInt(texels, row0 + x0), t10 = GatherInt(texels, row0 + x1);
    t01 = GatherInt(texels, row1 + x0), t11 = GatherInt(texels, row1 + x1);
  }
  const auto channel = [&](int shift) {
    const auto value = [&](Ints t) { return ToFloat((t >> shift) & SplatInt<F>(0xff)); };
    const F top = Fma(value(t10) - value(t00), fx, value(t00));
    const F bottom = Fma(value(t11) - value(t01), fx, value(t01));
    return Fma(bottom - top, fy, top) * Splat<F>(1 / 255.0f);
  };
  return {channel(0), channel(8), channel(16), texture.is_transparent ? channel(24) : Splat<F>(1)};
}

// Looks up texels bilinearly, and trilinearly if two levels are blended. u points right and v down,
// and both repeat.
template <class F>
Texels<F> Sample(const RasterTexture& texture, const MipLevels<F>& levels, F u, F v) {
  u = u - Floor(u), v = v - Floor(v);
  const Texels<F> a = SampleLevels(texture, levels.fine, u, v);
  constexpr int kGroups = MipLevels<F>::kGroups;
  if (levels.share[0] == 0 && levels.share[kGroups - 1] == 0) return a;
  int next[kGroups];
  for (int i = 0; i < kGroups; ++i) next[i] = levels.fine[i] + (levels.share[i] > 0 ? 1 : 0);
  const Texels<F> b = SampleLevels(texture, next, u, v);
  const F k = ByGroup(levels.share);
  return {Mixed(a.r, b.r, k), Mixed(a.g, b.g, k), Mixed(a.b, b.b, k), Mixed(a.a, b.a, k)};
}

}  // namespace gsv::rendering::raster
