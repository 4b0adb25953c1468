// The pixels of a vector: groups of eight pixels of a row.
#pragma once

#include "gsv/rendering/raster/simd.h"

namespace gsv::rendering::raster {

// The places in an image of the lanes of a vector.
template <class F>
struct Pixels {
  static constexpr int kGroups = Lanes<F>::kGroups;

  // Returns the columns and the rows of all lanes, relative to this origin.
  F ColumnsFrom(float x0) const {
    float first[kGroups];
    for (int i = 0; i < kGroups; ++i) first[i] = static_cast<float>(x[i]) - x0;
    return SplatGroups<F>(first) + Steps<F>();
  }
  F RowsFrom(float y0) const {
    float rows[kGroups];
    for (int i = 0; i < kGroups; ++i) rows[i] = static_cast<float>(y[i]) - y0;
    return SplatGroups<F>(rows);
  }

  // Returns the places of the pixels in an array of rows with `stride` elements.
  Places<F> In(std::size_t stride) const {
    Places<F> places;
    for (int i = 0; i < kGroups; ++i) {
      places.of[i] = static_cast<std::size_t>(y[i]) * stride + static_cast<std::size_t>(x[i]);
    }
    return places;
  }

  int x[kGroups], y[kGroups];  // the first pixel of each group
};

}  // namespace gsv::rendering::raster
