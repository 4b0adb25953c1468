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

// A triangle's surface over the picture. Plane i is a (x - x0) + b (y - y0) + c at the middle of
// pixel (x, y); texture coordinates and normals are divided by w, which makes them planes.
struct TriangleSurface {
  struct Plane {
    float a, b, c;
  };
  Plane inverse_w, u, v;
  Plane normal[3];       // not of unit length, unless it is the same everywhere
  bool is_flat = false;  // the normal is c
  int number = 0;
};

TriangleSurface SurfaceOf(const Drawn& drawn, const Triangle& triangle);

// Fills in the lanes of `mask`, which see one triangle: pixels from (x, y) to the right; the first
// to do so fills in something everywhere. `ray` is where they look, its part along the view
// being 1.
void FillIn(const Drawn& drawn, const Triangle& triangle, const TriangleSurface& surface, int x,
            int y, I8 mask, bool is_first, const F8x3& ray, Surfaces& surfaces);

}  // namespace gsv::rendering::raster
