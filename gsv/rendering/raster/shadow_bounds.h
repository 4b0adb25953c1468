// Bounds of the depths of a shadow map, for each block of texels. For most points, the bounds
// suffice: a point above the upper bound is lit, and a point below the lower bound is in shadow.
#pragma once

#include <span>
#include <vector>

#include "gsv/base/thread_team.h"
#include "gsv/rendering/raster/simd.h"
#include "gsv/rendering/scene/shadow_region.h"

namespace gsv::rendering::raster {

// A look-up at (x, y), in texels from the map's corner, may read the texels from x - kBefore to
// x + kAfter, both rounded down, and likewise for y. The centre of each of them is at most kBesideX
// and kBesideY away from (x, y).
class ShadowBounds {
 public:
  static constexpr int kBefore = 2, kAfter = 2;
  static constexpr float kBesideX = 1.601f, kBesideY = 1.301f;

  // Computes the bounds that depend on the texels of `parts`, on the threads of `team`. `map`
  // points to texel (0, 0) of a map with a border of at least one texel, and `stride` is the number
  // of texels from row to row.
  void Update(const float* map, std::ptrdiff_t stride,
              std::span<const ShadowRegion::Rectangle> parts, base::ThreadTeam& team);

  // The lowest and the highest depth that look-ups at (x, y) may read. Look-ups outside the map
  // read the texels at its border.
  template <class F>
  struct Range {
    F min, max;
  };
  // Returns the ranges for look-ups at the points of a vector.
  template <class F>
  Range<F> At(F x, F y) const {
    constexpr float kLast = kShadowSide - 0.5f;
    x = Min(Max(x, Splat<F>(0)), Splat<F>(kLast)) * Splat<F>(1.0f / kBlock);
    y = Min(Max(y, Splat<F>(0)), Splat<F>(kLast)) * Splat<F>(1.0f / kBlock);
    const F column = Floor(x), row = Floor(y);
    const float* blocks = &blocks_.data()->min;
    const auto at = (Truncated(row) * SplatInt<F>(kSide) + Truncated(column)) * 4;
    const auto range = GatherPairs(blocks, at), slope = GatherPairs(blocks + 2, at);
    return {(F)range.first,
            Fma((F)slope.first, x - column, Fma((F)slope.second, y - row, (F)range.second))};
  }

 private:
  static constexpr int kBlock = 8;  // in texels
  static constexpr int kSide = kShadowSide / kBlock;

  // The bounds of a block of texels. The upper bound is a plane. On a tilted surface, the depths in
  // a block differ by more than the offset between a surface and its own depths in the map. So a
  // part of a lit surface would be below a constant bound, and would need a look-up.
  struct Block {
    float min = 0;
    float max = 0;                   // upper bound at the block's corner with the lowest x and y
    float slope_x = 0, slope_y = 0;  // change of the upper bound across the whole block
  };
  // Computes the bounds of the block at (x, y).
  static Block BoundsOf(const float* map, std::ptrdiff_t stride, int x, int y);

  std::vector<Block> blocks_ = std::vector<Block>(std::size_t{kSide} * kSide);  // row by row
};

}  // namespace gsv::rendering::raster
