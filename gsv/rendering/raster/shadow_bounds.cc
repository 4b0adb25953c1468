#include "gsv/rendering/raster/shadow_bounds.h"

#include <algorithm>
#include <bitset>
#include <cmath>

namespace gsv::rendering::raster {
namespace {

float Least(F8 a) {
  float least = a[0];
  for (int lane = 1; lane < 8; ++lane) least = std::min(least, a[lane]);
  return least;
}

float Most(F8 a) {
  float most = a[0];
  for (int lane = 1; lane < 8; ++lane) most = std::max(most, a[lane]);
  return most;
}

}  // namespace

void ShadowBounds::Update(const float* map, std::ptrdiff_t stride,
                          std::span<const ShadowRegion::Rectangle> parts, base::ThreadTeam& team) {
  constexpr std::size_t kRows = 8;  // rows of blocks that a thread takes at once
  const auto first = [](int texel) { return std::max(0, (texel - kAfter) / kBlock); };
  const auto end = [](int texel) { return std::min(kSide, (texel - 1 + kBefore) / kBlock + 1); };
  team.ParallelFor(kSide, kRows, [&](std::size_t begin_row, std::size_t end_row) {
    for (int y = static_cast<int>(begin_row); y < static_cast<int>(end_row); ++y) {
      // Parts overlap, but each block is computed once.
      std::bitset<kSide> is_changed;
      for (const ShadowRegion::Rectangle& part : parts) {
        if (part.min_x >= part.max_x || part.min_y >= part.max_y) continue;
        if (y < first(part.min_y) || y >= end(part.max_y)) continue;
        for (int x = first(part.min_x); x < end(part.max_x); ++x) {
          is_changed.set(static_cast<std::size_t>(x));
        }
      }
      if (is_changed.none()) continue;
      for (int x = 0; x < kSide; ++x) {
        if (!is_changed[static_cast<std::size_t>(x)]) continue;
        blocks_[static_cast<std::size_t>(kSide * y + x)] = BoundsOf(map, stride, x, y);
      }
    }
  });
}

ShadowBounds::Block ShadowBounds::BoundsOf(const float* map, std::ptrdiff_t stride, int x, int y) {
  const int x0 = kBlock * x, y0 = kBlock * y;
  // The range of texels that look-ups in the block may read. Two vectors of eight texels cover each
  // row of this range.
  const int top = std::max(-1, y0 - kBefore),
            bottom = std::min(kShadowSide, y0 + kBlock - 1 + kAfter);
  const int left = std::max(-1, x0 - kBefore),
            right = std::min(kShadowSide, x0 + kBlock - 1 + kAfter) - 7;
  const auto for_each = [&](const auto& visit) {
    for (int row = top; row <= bottom; ++row) {
      for (const int column : {left, right}) visit(Load(map + stride * row + column), column, row);
    }
  };
  F8 lowest = Load(map + stride * top + left), highest = lowest;
  for_each([&](F8 depths, int, int) {
    lowest = Min(lowest, depths);
    highest = Max(highest, depths);
  });
  Block block{Least(lowest), Most(highest), 0, 0};
  if (block.min == block.max) return block;
  // The slopes of the upper bound are computed from the depths at the corners of the block. The
  // bound is correct with any slopes, because its height is computed below. With these slopes it is
  // tight if the surface is a plane.
  constexpr int kEnd = kBlock - 1;
  const auto depth = [&](int column, int row) { return map[stride * (y0 + row) + x0 + column]; };
  const float by_x =
                  (depth(kEnd, 0) + depth(kEnd, kEnd) - depth(0, 0) - depth(0, kEnd)) / (2 * kEnd),
              by_y =
                  (depth(0, kEnd) + depth(kEnd, kEnd) - depth(0, 0) - depth(kEnd, 0)) / (2 * kEnd);
  // The plane by_x dx + by_y dy has these slopes. Finds how far the highest depth is above it.
  F8 above = Splat(-1e30f);
  for_each([&](F8 depths, int column, int row) {
    const F8 dx = Splat(static_cast<float>(column - x0) + 0.5f) + Steps();
    const float dy = static_cast<float>(row - y0) + 0.5f;
    above = Max(above, Fma(Splat(-by_x), dx, depths - Splat(by_y * dy)));
  });
  // This margin is larger than all rounding errors.
  constexpr float kSlack = 1e-6f;
  const float plane = Most(above) + kBesideX * std::abs(by_x) + kBesideY * std::abs(by_y) + kSlack;
  // The sloped plane replaces the flat bound if it is lower at the middle of the block.
  constexpr float kMiddle = 0.5f * kBlock;
  if (plane + kMiddle * (by_x + by_y) < block.max) {
    block.max = plane;
    block.slope_x = kBlock * by_x, block.slope_y = kBlock * by_y;
  }
  return block;
}

}  // namespace gsv::rendering::raster
