// Mipmapped textures, and look-ups at the points of a vector.
#pragma once

#include <type_traits>
#include <vector>

#include "gsv/rendering/raster/simd.h"
#include "gsv/rendering/scene/texture_store.h"

namespace gsv::rendering::raster {

// A texture and its mipmaps.
struct RasterTexture final : DrawTexture {
  struct Level {
    int width = 0, height = 0;
    std::int32_t first = 0;   // index of the level's first texel in `texels`
    std::int32_t unused = 0;  // makes the size a multiple of 16 bytes, for LevelSizes
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

// The levels of detail of a look-up, for each lane.
template <class F>
struct MipLevels {
  typename Lanes<F>::Ints fine;  // a level of the texture
  F share;                       // the share of the next level, from 0 to less than 1

  MipLevels(typename Lanes<F>::Ints of_fine, F of_share) : fine(of_fine), share(of_share) {}
  // Two levels n and n + 1 are blended only if `level` is about halfway between them.
  MipLevels(const RasterTexture& texture, F level) {
    using Ints = typename Lanes<F>::Ints;
    // The width of the range about n + 0.5 in which two levels are blended.
    constexpr float kBand = 0.4f;
    const F zero = Splat<F>(0), one = Splat<F>(1);
    const int last = static_cast<int>(texture.levels.size()) - 1;
    // NaN becomes 0.
    const F within =
        Select(Less(zero, level), Min(level, Splat<F>(static_cast<float>(last))), zero);
    fine = Truncated(within);
    share = Clamp01((within - ToFloat(fine) - Splat<F>(0.5f)) / Splat<F>(kBand) + Splat<F>(0.5f));
    share = Select(EqualInt(fine, SplatInt<F>(last)), zero, share);
    const auto is_next = AtLeast(share, one);
    const Ints next = fine + 1;
    fine = SelectInt(is_next, next, fine);
    share = Select(is_next, zero, share);
  }
};

// The sizes of levels of a texture, for each lane, and the indices of their first texels.
template <class F>
struct LevelSizes {
  typename Lanes<F>::Ints width, height, first;

  LevelSizes(const RasterTexture& texture, typename Lanes<F>::Ints levels) {
    const RasterTexture::Level* table = texture.levels.data();
    const std::int32_t level = levels[0];
    if (Bits(EqualInt(levels, SplatInt<F>(level))) == (1 << Lanes<F>::kCount) - 1) {
      width = SplatInt<F>(table[level].width), height = SplatInt<F>(table[level].height);
      first = SplatInt<F>(table[level].first);
      return;
    }
    static_assert(sizeof(RasterTexture::Level) == 4 * sizeof(std::int32_t));
    const auto sizes = GatherPairs(&table->width, levels * 4);
    width = sizes.first, height = sizes.second;
    first = GatherInt(&table->first, levels * 4);
  }
};

// Looks up texels bilinearly in one level for each lane. u points right and v down, from 0 to 1.
template <class F>
Texels<F> SampleLevels(const RasterTexture& texture, const LevelSizes<F>& sizes, F u, F v) {
  using Ints = typename Lanes<F>::Ints;
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
  const F fx = axis(u, sizes.width, x0, x1), fy = axis(v, sizes.height, y0, y1);
  const std::uint32_t* texels = texture.texels.data();
  const Ints row0 = y0 * sizes.width + sizes.first, row1 = y1 * sizes.width + sizes.first;
  Ints t00, t10, t01, t11;
  if (Bits(EqualInt(x1, x0 + 1)) == (1 << Lanes<F>::kCount) - 1) {
    const auto upper = GatherPairs(texels, row0 + x0), lower = GatherPairs(texels, row1 + x0);
    t00 = upper.first, t10 = upper.second, t01 = lower.first, t11 = lower.second;
  } else {  // some texels are at both edges of the texture, which repeats
    t00 = GatherInt(texels, row0 + x0), t10 = GatherInt(texels, row0 + x1);
    t01 = GatherInt(texels, row1 + x0), t11 = GatherInt(texels, row1 + x1);
  }
  const auto channel = [&]<int K>(std::integral_constant<int, K>) {
    const F v00 = ToFloat(Byte<K>(t00)), v01 = ToFloat(Byte<K>(t01));
    const F top = Fma(ToFloat(Byte<K>(t10)) - v00, fx, v00);
    const F bottom = Fma(ToFloat(Byte<K>(t11)) - v01, fx, v01);
    return Fma(bottom - top, fy, top) * Splat<F>(1 / 255.0f);
  };
  return {channel(std::integral_constant<int, 0>()), channel(std::integral_constant<int, 1>()),
          channel(std::integral_constant<int, 2>()),
          texture.is_transparent ? channel(std::integral_constant<int, 3>()) : Splat<F>(1)};
}

// Looks up texels bilinearly, and trilinearly if two levels are blended. u points right and v down,
// and both repeat. Lanes outside `needed` get any colours.
template <class F>
Texels<F> Sample(const RasterTexture& texture, const MipLevels<F>& levels, F u, F v,
                 typename Lanes<F>::Mask needed) {
  u = u - Floor(u), v = v - Floor(v);
  const Texels<F> a = SampleLevels(texture, LevelSizes<F>(texture, levels.fine), u, v);
  const auto is_blended = Less(Splat<F>(0), levels.share);
  if (!Any(needed & is_blended)) return a;
  const auto next = SelectInt(is_blended, levels.fine + 1, levels.fine);
  const Texels<F> b = SampleLevels(texture, LevelSizes<F>(texture, next), u, v);
  const F k = levels.share;
  return {Mixed(a.r, b.r, k), Mixed(a.g, b.g, k), Mixed(a.b, b.b, k), Mixed(a.a, b.a, k)};
}

}  // namespace gsv::rendering::raster
