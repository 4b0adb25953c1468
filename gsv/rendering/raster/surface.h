// What is seen at eight pixels: the surfaces of the triangles there.
#pragma once

#include "gsv/rendering/raster/rasteriser.h"

namespace gsv::rendering::raster {

// Of eight pixels, each of its own triangle. Colours are linear.
struct Surfaces {
  F8 w;              // distance along the view
  F8x3 normal;       // towards the camera; bumps included
  F8x3 face_normal;  // without bumps
  F8x3 base, emissive;
  F8 alpha, metalness, roughness;
  I8 number;  // of the surface, from 1 to 255
};

// Fills in the lanes of `mask`, which see one triangle: pixels from (x, y) to the right. `ray` is
// where they look, its part along the view being 1.
void FillIn(const Drawn& drawn, const Triangle& triangle, int x, int y, I8 mask, const F8x3& ray,
            Surfaces& surfaces);

}  // namespace gsv::rendering::raster
