// The surfaces at eight pixels.
#pragma once

#include "gsv/rendering/raster/rasteriser.h"

namespace gsv::rendering::raster {

// The surfaces of eight pixels, each of its own triangle. Colours are linear.
struct Surfaces {
  F8 w;              // distance along the view
  F8x3 normal;       // towards the camera; including normal map
  F8x3 face_normal;  // without normal map
  F8x3 base, emissive;
  F8 alpha, metalness, roughness;
  I8 number;  // of the surface, from 1 to 255
};

// A triangle's surface over the image. Plane i is a (x - x0) + b (y - y0) + c at the centre of
// pixel (x, y). Texture coordinates and normals are divided by w, and so linear.
struct TriangleSurface {
  struct Plane {
    float a, b, c;
  };
  Plane inverse_w, u, v;
  Plane normal[3];       // not of unit length, unless constant
  bool is_flat = false;  // the normal is c
  int number = 0;
};

TriangleSurface SurfaceOf(const Drawn& drawn, const Triangle& triangle);

// Fills in the lanes of `mask`, which see one triangle: pixels from (x, y) to the right. The first
// call fills in all lanes. `ray` is the direction of the pixels, with the component 1 along the
// view.
void FillIn(const Drawn& drawn, const Triangle& triangle, const TriangleSurface& surface, int x,
            int y, I8 mask, bool is_first, const F8x3& ray, Surfaces& surfaces);

}  // namespace gsv::rendering::raster
