// A depth grid: the depths of an image at some of its pixels.
//
// Sample (i, j) is that of pixel (min(i * spacing, width - 1), min(j * spacing, height - 1)), so
// that the samples include all borders of the image. In the image of a plane, the inverse depth is
// a linear function of the pixel's position. So linear interpolation between samples is exact for
// planes.
// Units  pixels, 1/m.
#pragma once

#include <algorithm>
#include <cstddef>
#include <memory>
#include <vector>

#include "gsv/model/image.h"

namespace gsv::rendering {

// The depths of an image at some of its pixels.
struct DepthGrid {
  int width = 0, height = 0;  // size of the image
  int spacing = 1;            // distance between samples
  int columns = 0, rows = 0;  // numbers of samples
  // For each sample, in rows from the top, the inverse of the depth along the camera's axis; 0 for
  // the background. Transparent surfaces are left out.
  std::vector<float> inverse_depth;
};

// An image and its depths.
struct ImageWithDepth {
  std::shared_ptr<const model::Image> image;
  // Null on processors without AVX2 and FMA, which the rasteriser requires.
  std::shared_ptr<const DepthGrid> depth;
};

// Returns the number of samples in a row or column of `pixels` pixels.
constexpr int DepthSamples(int pixels, int spacing) {
  return (std::max(pixels - 1, 0) + spacing - 1) / spacing + 1;
}

// Returns the grid whose samples have the values of `inverse_depth(x, y)`.
template <typename InverseDepth>
DepthGrid MakeDepthGrid(int width, int height, int spacing, InverseDepth&& inverse_depth) {
  DepthGrid grid{
      width, height, spacing, DepthSamples(width, spacing), DepthSamples(height, spacing), {}};
  grid.inverse_depth.reserve(static_cast<std::size_t>(grid.columns) *
                             static_cast<std::size_t>(grid.rows));
  for (int row = 0; row < grid.rows; ++row) {
    const int y = std::min(row * spacing, height - 1);
    for (int column = 0; column < grid.columns; ++column) {
      grid.inverse_depth.push_back(inverse_depth(std::min(column * spacing, width - 1), y));
    }
  }
  return grid;
}

}  // namespace gsv::rendering
