// Computes the pixels of a box that a triangle covers.
#pragma once

#include <algorithm>
#include <cmath>

#include "gsv/rendering/raster/simd.h"
#include "gsv/rendering/raster/triangle.h"

namespace gsv::rendering::raster {

#pragma GCC push_options
#pragma GCC target("avx2,fma")

// Narrows a row of pixels to those where no q_i is negative. Pixels are counted from the first of
// the box.
inline void Narrow(const Triangle& t, const float (&row)[3], float& left, float& right) {
  for (int i = 0; i < 3; ++i) {
    if (t.a[i] > 0) {
      left = std::max(left, -row[i] / t.a[i]);
    } else if (t.a[i] < 0) {
      right = std::min(right, -row[i] / t.a[i]);
    } else if (row[i] < 0) {
      right = -1;
    }
  }
}

// Calls block(x, y, covered, inverse_w) for pixels x to x + 7 of row y if the triangle covers one
// of them. Rows have seven pixels of padding.
template <class Block>
void Scan(const Triangle& t, const Box& box, Block&& block) {
  // Adjacent triangles overlap by this many pixels, so that rounding leaves no gap between them.
  constexpr float kOverlap = 1e-3f;
  constexpr int kWide = 16;
  const float slack[3] = {kOverlap * (std::abs(t.a[0]) + std::abs(t.b[0])),
                          kOverlap * (std::abs(t.a[1]) + std::abs(t.b[1])),
                          kOverlap * (std::abs(t.a[2]) + std::abs(t.b[2]))};
  const F8 a0 = Splat(t.a[0]), a1 = Splat(t.a[1]), a2 = Splat(t.a[2]);
  const F8 a = a0 + a1 + a2;
  const float total_slack = slack[0] + slack[1] + slack[2];
  const bool wide = box.x1 - box.x0 >= kWide;
  const float first_x = static_cast<float>(box.x0) - t.x0;
  for (int y = box.y0; y <= box.y1; ++y) {
    const float dy = static_cast<float>(y) - t.y0;
    const float row[3] = {t.c[0] + t.b[0] * dy + slack[0] + t.a[0] * first_x,
                          t.c[1] + t.b[1] * dy + slack[1] + t.a[1] * first_x,
                          t.c[2] + t.b[2] * dy + slack[2] + t.a[2] * first_x};
    int begin = box.x0, end = box.x1;
    if (wide) {
      float left = 0, right = static_cast<float>(box.x1 - box.x0);
      Narrow(t, row, left, right);
      if (!(left <= right + 1)) continue;
      begin = box.x0 + std::max(0, static_cast<int>(left));
      end = box.x0 + static_cast<int>(std::max(right, -1.0f));
    }
    const F8 r0 = Splat(row[0]), r1 = Splat(row[1]), r2 = Splat(row[2]);
    const F8 depth_row = r0 + r1 + r2 - Splat(total_slack);
    for (int x = begin; x <= end; x += 8) {
      const F8 dx = Splat(static_cast<float>(x - box.x0)) + Steps();
      const F8 inside = Min(Min(Fma(a0, dx, r0), Fma(a1, dx, r1)), Fma(a2, dx, r2));
      const I8 covered = inside >= Splat(0);
      if (Bits(covered) != 0) block(x, y, covered, Fma(a, dx, depth_row));
    }
  }
}

#pragma GCC pop_options

}  // namespace gsv::rendering::raster
