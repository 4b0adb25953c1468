// Computes the pixels of a box that a triangle covers.
#pragma once

#include <algorithm>
#include <cmath>

#include "gsv/rendering/raster/pixels.h"
#include "gsv/rendering/raster/triangle.h"

namespace gsv::rendering::raster {

#pragma GCC push_options
#pragma GCC target("avx2,fma")

// Narrows the pixels [left, right] of eight rows to those where no q_i is negative. `rows` has the
// q_i of each row at pixel 0, the first pixel of the box.
inline void Narrow(const Triangle& t, const F8 (&rows)[3], F8& left, F8& right) {
  for (int i = 0; i < 3; ++i) {
    if (t.a[i] > 0) {
      left = Max(-rows[i] / Splat(t.a[i]), left);
    } else if (t.a[i] < 0) {
      right = Min(-rows[i] / Splat(t.a[i]), right);
    } else {
      right = Select(rows[i] < Splat(0), Splat(-1), right);
    }
  }
}

#pragma GCC pop_options

// Calls block(pixels, covered, inverse_w) for vectors of pixels of which the triangle covers some. Each
// group of pixels is in another row. The pixels may be up to seven pixels beyond the box, so rows need
// padding. A group without covered pixels may begin up to the width of the box beyond it.
template <class F, class Block>
__attribute__((always_inline)) inline void Scan(const Triangle& t, const Box& box, Block&& block) {
  // Adjacent triangles overlap by this many pixels, so that rounding leaves no gap between them.
  constexpr float kOverlap = 1e-3f;
  constexpr int kWide = 16, kGroups = Lanes<F>::kGroups;
  const float slack[3] = {kOverlap * (std::abs(t.a[0]) + std::abs(t.b[0])),
                          kOverlap * (std::abs(t.a[1]) + std::abs(t.b[1])),
                          kOverlap * (std::abs(t.a[2]) + std::abs(t.b[2]))};
  const F a0 = Splat<F>(t.a[0]), a1 = Splat<F>(t.a[1]), a2 = Splat<F>(t.a[2]);
  const F a = a0 + a1 + a2;
  const float total_slack = slack[0] + slack[1] + slack[2];
  const int width = box.x1 - box.x0 + 1;
  const bool wide = width > kWide;
  const float first_x = static_cast<float>(box.x0) - t.x0;
  // Each iteration computes eight rows, one per lane.
  for (int first_y = box.y0; first_y <= box.y1; first_y += 8) {
    const F8 dy = Splat(static_cast<float>(first_y) - t.y0) + Steps();
    F8 rows[3];
    for (int i = 0; i < 3; ++i) {
      rows[i] = Splat(t.c[i]) + Splat(t.b[i]) * dy + Splat(slack[i]) + Splat(t.a[i] * first_x);
    }
    const F8 inverse_w = rows[0] + rows[1] + rows[2] - Splat(total_slack);
    const int row_count = std::min(8, box.y1 - first_y + 1);
    const I8 in_box = IntSteps() < SplatInt(row_count);
    // For each row, the first pixel, and the number of groups of pixels.
    I8 begin = SplatInt(0), groups = SplatInt((width + 7) / 8) & in_box;
    alignas(32) std::int32_t begins[8], counts[8];
    if (wide) {
      F8 left = Splat(0), right = Splat(static_cast<float>(width - 1));
      Narrow(t, rows, left, right);
      begin = MaxInt(Truncated(left), SplatInt(0));
      groups = (Truncated(Max(right, Splat(-1))) - begin + SplatInt(8)) >> 3;
      groups = MaxInt(groups, SplatInt(0)) & in_box & (left <= right + Splat(1));
      begin &= groups > SplatInt(0);
      StoreInt(begins, begin);
      StoreInt(counts, groups);
    }
    const F8 first_dx = ToFloat(begin), end_dx = ToFloat(begin + groups * 8);
    for (int row = 0; row < row_count; row += kGroups) {
      Pixels<F> pixels;
      int count = wide ? 0 : (width + 7) / 8;
      for (int i = 0; i < kGroups; ++i) {
        pixels.x[i] = box.x0, pixels.y[i] = first_y + row + i;
        if (!wide) continue;
        pixels.x[i] += begins[row + i];
        count = std::max(count, counts[row + i]);
      }
      const auto of_rows = [&](F8 values) { return FromLanes<F>(values, row); };
      const F r0 = of_rows(rows[0]), r1 = of_rows(rows[1]), r2 = of_rows(rows[2]);
      const F depths = of_rows(inverse_w), end = of_rows(end_dx);
      F dx = of_rows(first_dx) + Steps<F>();
      for (; count > 0; --count) {
        const F inside = Min(Min(Fma(a0, dx, r0), Fma(a1, dx, r1)), Fma(a2, dx, r2));
        auto covered = AtLeast(inside, Splat<F>(0));
        if (kGroups > 1) covered = covered & Less(dx, end);
        block(pixels, covered, Fma(a, dx, depths));
        dx = dx + Splat<F>(8);
        for (int& x : pixels.x) x += 8;
      }
    }
  }
}

}  // namespace gsv::rendering::raster
