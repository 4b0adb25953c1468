// Computes the surfaces that eight pixels see.
#pragma once

#include "gsv/rendering/raster/rasteriser.h"

namespace gsv::rendering::raster {

// The surfaces at eight pixels, each of which may see another triangle. Colours are linear.
struct Surfaces {
  F8 w;              // distance along the view
  F8x3 normal;       // points towards the camera and includes the normal map
  F8x3 face_normal;  // does not include the normal map; only set if has_normal_map
  bool has_normal_map = false;
  F8x3 base, emissive;  // base colour and emitted light
  F8 alpha, metalness, roughness;
  F8 occlusion;  // the fraction of ambient light that reaches the surface
  I8 number;     // number of the surface, from 1 to 255
  // The item whose material all filled lanes have, if the material has no textures; else null.
  const Drawn* plain = nullptr;
};

// The attributes of a triangle's surface as functions of the pixel. The value of a plane at the
// centre of pixel (x, y) is a (x - x0) + b (y - y0) + c. Texture coordinates and normals are
// divided by w, and so are linear.
struct TriangleSurface {
  struct Plane {
    float a, b, c;
  };
  Plane inverse_w, u, v;
  Plane normal[3];       // not of unit length, unless the normal is constant
  bool is_flat = false;  // the normal is the constant term c of the planes
  int number = 0;
};

// Computes the attributes of a visible triangle.
TriangleSurface SurfaceOf(const Drawn& drawn, const Triangle& triangle);

// Fills in the lanes of `mask`, which all see this triangle: pixels from (x, y) to the right. The
// first call must fill in all lanes. `ray` is the direction of each pixel, with the component 1
// along the view.
void FillIn(const Drawn& drawn, const Triangle& triangle, const TriangleSurface& surface, int x,
            int y, I8 mask, bool is_first, const F8x3& ray, Surfaces& surfaces);

}  // namespace gsv::rendering::raster
