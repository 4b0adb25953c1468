// Computes the pixels of a box that a triangle covers.
#pragma once

#include <algorithm>
#include <cmath>

#include "gsv/rendering/raster/simd.h"
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

// Calls block(x, y, covered, inverse_w) for vectors of pixels from (x, y) to the right of which the
// triangle covers some. These pixels may be up to seven pixels beyond the box, so rows need padding.
// For longer vectors, the other lanes beyond the box are not covered.
template <class F, class Block>
__attribute__((always_inline)) inline void Scan(const Triangle& t, const Box& box, Block&& block) {
  // Adjacent triangles overlap by this many pixels, so that rounding leaves no gap between them.
  constexpr float kOverlap = 1e-3f;
  constexpr int kWide = 16, kLanes = Lanes<F>::kCount;
  const float slack[3] = {kOverlap * (std::abs(t.a[0]) + std::abs(t.b[0])),
                          kOverlap * (std::abs(t.a[1]) + std::abs(t.b[1])),
                          kOverlap * (std::abs(t.a[2]) + std::abs(t.b[2]))};
  const F a0 = Splat<F>(t.a[0]), a1 = Splat<F>(t.a[1]), a2 = Splat<F>(t.a[2]);
  const F a = a0 + a1 + a2;
  const float total_slack = slack[0] + slack[1] + slack[2];
  const bool wide = box.x1 - box.x0 >= kWide;
  const float first_x = static_cast<float>(box.x0) - t.x0;
  // Each iteration computes eight rows, one per lane.
  for (int first_y = box.y0; first_y <= box.y1; first_y += 8) {
    const F8 dy = Splat(static_cast<float>(first_y) - t.y0) + Steps();
    F8 rows[3];
    for (int i = 0; i < 3; ++i) {
      rows[i] = Splat(t.c[i]) + Splat(t.b[i]) * dy + Splat(slack[i]) + Splat(t.a[i] * first_x);
    }
    I8 seen = IntSteps() <= SplatInt(box.y1 - first_y);
    alignas(32) float q[3][8], inverse_w[8];
    alignas(32) std::int32_t begins[8], ends[8];
    for (int i = 0; i < 3; ++i) Store(q[i], rows[i]);
    Store(inverse_w, rows[0] + rows[1] + rows[2] - Splat(total_slack));
    if (wide) {
      F8 left = Splat(0), right = Splat(static_cast<float>(box.x1 - box.x0));
      Narrow(t, rows, left, right);
      seen &= left <= right + Splat(1);
      StoreInt(begins, SplatInt(box.x0) + MaxInt(Truncated(left), SplatInt(0)));
      StoreInt(ends, SplatInt(box.x0) + Truncated(Max(right, Splat(-1))));
    }
    for (int left = Bits(seen); left != 0; left &= left - 1) {
      const int lane = __builtin_ctz(static_cast<unsigned>(left));
      const F r0 = Splat<F>(q[0][lane]), r1 = Splat<F>(q[1][lane]), r2 = Splat<F>(q[2][lane]);
      const F depth_row = Splat<F>(inverse_w[lane]);
      const int end = wide ? ends[lane] : box.x1;
      for (int x = wide ? begins[lane] : box.x0; x <= end; x += kLanes) {
        const F dx = Splat<F>(static_cast<float>(x - box.x0)) + Steps<F>();
        const F inside = Min(Min(Fma(a0, dx, r0), Fma(a1, dx, r1)), Fma(a2, dx, r2));
        auto covered = AtLeast(inside, Splat<F>(0));
        if (kLanes == 16 && x + 8 > end) covered = FirstEight(covered);
        if (Bits(covered) != 0) block(x, first_y + lane, covered, Fma(a, dx, depth_row));
      }
    }
  }
}

}  // namespace gsv::rendering::raster
