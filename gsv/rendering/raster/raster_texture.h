// Mipmapped textures, and look-ups at the points of a vector.
#pragma once

#include <type_traits>
#include <vector>

#include "gsv/rendering/raster/simd.h"
#include "gsv/rendering/scene/texture_store.h"

namespace gsv::rendering::raster {

// A texture and its mipmaps. Each level is half as large as the one before. Around it there is a border
// of one texel, which repeats the texels of the opposite edge.
struct RasterTexture final : DrawTexture {
  static constexpr int kMaxLevels = 16;

  int level_count = 0;
  // Properties of the levels: the size without the border, the index of the first texel in the border,
  // and the number of texels from row to row.
  float width[kMaxLevels] = {}, height[kMaxLevels] = {};
  std::int32_t first[kMaxLevels] = {}, stride[kMaxLevels] = {};
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
    const int last = texture.level_count - 1;
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

// Looks up texels bilinearly in one level for each lane. u points right and v down, from 0 to 1.
template <class F>
Texels<F> SampleLevels(const RasterTexture& texture, typename Lanes<F>::Ints levels, F u, F v) {
  // Returns the first of two texels, counted from the border, and sets the share of the second one.
  const auto axis = [](F at, F size, F& share) {
    // NaN, which may occur in invisible pixels, becomes the edge of the texture.
    const F x = Min(Max(Fma(at, size, Splat<F>(-0.5f)), Splat<F>(-0.5f)), size - Splat<F>(0.5f));
    const F whole = Floor(x);
    share = x - whole;
    return Truncated(whole) + 1;
  };
  F fx, fy;
  const auto x = axis(u, FromTable<F>(texture.width, levels), fx);
  const auto y = axis(v, FromTable<F>(texture.height, levels), fy);
  const auto stride = FromTable<F>(texture.stride, levels);
  const auto at = FromTable<F>(texture.first, levels) + y * stride + x;
  const std::uint32_t* texels = texture.texels.data();
  const auto upper = GatherPairs(texels, at), lower = GatherPairs(texels, at + stride);
  const auto channel = [&]<int K>(std::integral_constant<int, K>) {
    const auto along_x = [&](const auto& pair) {
      const F left = ToFloat(Byte<K>(pair.first));
      return Fma(ToFloat(Byte<K>(pair.second)) - left, fx, left);
    };
    const F top = along_x(upper), bottom = along_x(lower);
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
  const Texels<F> a = SampleLevels(texture, levels.fine, u, v);
  const auto is_blended = Less(Splat<F>(0), levels.share);
  if (!Any(needed & is_blended)) return a;
  const auto next = SelectInt(is_blended, levels.fine + 1, levels.fine);
  const Texels<F> b = SampleLevels(texture, next, u, v);
  const F k = levels.share;
  return {Mixed(a.r, b.r, k), Mixed(a.g, b.g, k), Mixed(a.b, b.b, k), Mixed(a.a, b.a, k)};
}

}  // namespace gsv::rendering::raster
