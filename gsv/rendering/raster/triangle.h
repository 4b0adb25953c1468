// A triangle for the rasteriser: one linear function of the pixel position per corner.
//
// Units  pixels.
#pragma once

#include <cstdint>

namespace gsv::rendering::raster {

// The function of corner i (see rasteriser.h) is q_i = c[i] + a[i] (x - x0) + b[i] (y - y0) at the
// centre of pixel (x, y).
struct Triangle {
  float a[3], b[3], c[3];
  float x0, y0;
  std::uint32_t corner[3];  // indices of the mesh's vertices
  std::uint32_t drawn;      // index of the item to which the triangle belongs
};

// A rectangle of pixels.
struct Box {
  int x0, y0, x1, y1;  // the bounding box in pixels, [x0, x1] by [y0, y1]
};

}  // namespace gsv::rendering::raster
