// The surfaces of triangles, and of pixels that see one triangle. See mixed_pixels.h for vectors of
// pixels that see any triangles.
#pragma once

#include <array>

#include "gsv/rendering/raster/pixels.h"
#include "gsv/rendering/raster/raster_texture.h"
#include "gsv/rendering/raster/rasteriser.h"
#include "gsv/rendering/raster/reflector.h"

namespace gsv::rendering::raster {

// The attributes of a triangle's surface as functions of the pixel, called planes. Their value at the
// centre of pixel (x, y) is a (x - x0) + b (y - y0) + c. Texture coordinates and normals are divided by
// w, and so are linear.
struct TriangleSurface {
  // Indices of the planes: 1/w, the texture coordinates, and the components of the normal, which does
  // not have unit length.
  enum Plane { kInverseW, kU, kV, kNormalX, kNormalY, kNormalZ };

  // Returns the values at pixels that are dx and dy away from (x0, y0).
  template <class F>
  F At(Plane i, F dx, F dy) const {
    return Fma(Splat<F>(a[i]), dx, Splat<F>(c[i]) + Splat<F>(b[i]) * dy);
  }

  alignas(32) float a[8], b[8], c[8];  // elements 6 and 7 are not used
  float x0 = 0, y0 = 0;
  // Whether the normal is constant. It then is the term c of its planes, has unit length, and a and b
  // are 0.
  bool is_flat = false;
  int number = 0;  // number of the surface, from 1 to 255
};

// Computes the attributes of a visible triangle.
TriangleSurface SurfaceOf(const Drawn& drawn, const Triangle& triangle);

// Approximates the binary logarithm of positive numbers from their exponent and fraction.
template <class F>
F Log2(F value) {
  return ToFloat((typename Lanes<F>::Ints)value) * Splat<F>(1.0f / (1 << 23)) - Splat<F>(127);
}

// A plane of a TriangleSurface, for each lane.
template <class F>
struct PlaneLanes {
  PlaneLanes() = default;
  PlaneLanes(const TriangleSurface& s, TriangleSurface::Plane i)
      : a(Splat<F>(s.a[i])), b(Splat<F>(s.b[i])), c(Splat<F>(s.c[i])) {}

  F a, b, c;
};

// Returns the mip levels at which a texel is about as large as a pixel, for pixels that are dx and dy
// away from their triangles' x0 and y0.
template <class F>
F LevelsAt(const PlaneLanes<F>& for_w, const PlaneLanes<F>& for_u, const PlaneLanes<F>& for_v, F dx,
           F dy, const RasterTexture& texture) {
  const auto at = [&](const PlaneLanes<F>& p) { return p.c + p.a * dx + p.b * dy; };
  const F inverse_w = at(for_w);
  const F w = Splat<F>(1) / inverse_w;
  const F u = at(for_u) * w, v = at(for_v) * w;
  const F width = Splat<F>(texture.width[0]);
  const F height = Splat<F>(texture.height[0]);
  const auto squared = [&](F by_u, F by_v, F by_w) {
    const F du = (by_u - u * by_w) * width, dv = (by_v - v * by_w) * height;
    return du * du + dv * dv;
  };
  const F max_change2 = Max(squared(for_u.b, for_v.b, for_w.b), squared(for_u.a, for_v.a, for_w.a));
  const F level = Splat<F>(0.5f) * Log2(Max(Splat<F>(1e-12f), max_change2 * w * w));
  return Select(Less(Splat<F>(0), inverse_w), level, Splat<F>(0));
}

// The axes of a normal map on a triangle, in the frame of FrustumOf(). If `is_valid` is false, the
// texture coordinates do not define the axes.
struct BumpAxes {
  bool is_valid = false;
  float right[3], down[3];
};
BumpAxes BumpAxesOf(const Drawn& drawn, const Triangle& triangle);

// Decodes sRGB with a cubic, as in shaders.cc.
template <class F>
F Decoded(F c) {
  return c * Fma(c, Fma(c, Splat<F>(0.305306011f), Splat<F>(0.682171111f)), Splat<F>(0.012522878f));
}
template <class F>
Three<F> Decoded(const Texels<F>& texel) {
  return {Decoded(texel.r), Decoded(texel.g), Decoded(texel.b)};
}

// Returns which pixels of an item with an alpha mask are opaque, at the finest level of the texture
// `holes`. dx and dy are pixels from the triangle's x0 and y0.
template <class F>
typename Lanes<F>::Mask Solid(const Triangle& t, const RasterMesh& mesh, const RasterTexture& holes,
                              F dx, F dy) {
  const auto q = [&](int i) {
    return Fma(Splat<F>(t.a[i]), dx, Splat<F>(t.c[i]) + Splat<F>(t.b[i]) * dy);
  };
  const F q0 = q(0), q1 = q(1), q2 = q(2);
  const F w = Splat<F>(1) / (q0 + q1 + q2);
  const F second = q1 * w, third = q2 * w;  // the weights of these corners
  const auto between = [&](TriangleSurface::Plane i) {
    const float v0 = mesh.attributes[t.corner[0]].values[i];
    return Fma(Splat<F>(mesh.attributes[t.corner[1]].values[i] - v0), second,
               Fma(Splat<F>(mesh.attributes[t.corner[2]].values[i] - v0), third, Splat<F>(v0)));
  };
  return AtLeast(Sample(holes, MipLevels<F>(holes, Splat<F>(0)), between(TriangleSurface::kU),
                        between(TriangleSurface::kV), EqualInt(IntSteps<F>(), IntSteps<F>()))
                     .a,
                 Splat<F>(0.5f));
}

// A material whose properties are the same everywhere, except that it may have a texture of the base
// colour. All lanes of a member have the same value.
template <class F>
struct EvenMaterial {
  EvenMaterial() = default;
  explicit EvenMaterial(const Drawn& drawn)
      : texture(static_cast<const RasterTexture*>(drawn.group->base_colour.get())),
        base(Splat<F>(drawn.factors->base_colour[0], drawn.factors->base_colour[1],
                      drawn.factors->base_colour[2])),
        metalness(Splat<F>(drawn.factors->emissive_metalness[3])),
        reflector(
            base, metalness,
            Splat<F>(drawn.factors->emissive_metalness[0], drawn.factors->emissive_metalness[1],
                     drawn.factors->emissive_metalness[2]),
            Splat<F>(1)),
        gloss(Splat<F>(drawn.factors->roughness)) {}

  const RasterTexture* texture = nullptr;
  Three<F> base;  // base colour; the texture is multiplied by it
  F metalness;
  Reflector<F> reflector;  // without a texture
  Gloss<F> gloss;
};
// Whether an item has such a material, and shows only the front sides of its triangles.
inline bool IsEven(const DrawGroup& group) {
  return !group.double_sided && !group.normal && !group.metallic_roughness && !group.emissive &&
         !group.occlusion && !group.light;
}

// The middle of the lanes of each mask of eight lanes; for no lane, that of the first lane.
inline constexpr std::array<float, 256> kMiddles = [] {
  std::array<float, 256> middles{};
  for (unsigned mask = 1; mask < 256; ++mask) {
    middles[mask] = 0.5f * static_cast<float>(__builtin_ctz(mask) + 31 - __builtin_clz(mask));
  }
  return middles;
}();

// Returns the middle of those lanes of each group that are set in `lanes`, relative to the first lane
// of the group: in lane n for the n-th group. A group without such lanes gets its first lane.
template <class F>
F8 MiddlesOf(int lanes) {
  float middles[Lanes<F>::kGroups];
  for (int i = 0; i < Lanes<F>::kGroups; ++i) {
    middles[i] = kMiddles[static_cast<std::size_t>(lanes >> 8 * i & 0xff)];
  }
  return OfGroups<F>(middles);
}

// The pixels of a vector, all of which see a triangle.
template <class F>
struct SeenPixels {
  SeenPixels(const TriangleSurface& of, const Pixels<F>& pixels)
      : surface(of),
        dx(pixels.ColumnsFrom(of.x0)),
        dy(pixels.RowsFrom(of.y0)),
        w(Splat<F>(1) / of.At(TriangleSurface::kInverseW, dx, dy)) {}

  // Looks up a texture at the pixels. The n-th group has the level of detail in lane `first` + n of
  // `levels`.
  Texels<F> Look(const RasterTexture& texture, const MipLevels<F8>& levels, int first) const {
    const MipLevels<F> of_groups{FromLanes<F>(levels.fine, first),
                                 FromLanes<F>(levels.share, first)};
    return Sample(texture, of_groups, surface.At(TriangleSurface::kU, dx, dy) * w,
                  surface.At(TriangleSurface::kV, dx, dy) * w, MaskOf<F>(-1));
  }

  const TriangleSurface& surface;
  F dx, dy;  // distances from the triangle's x0 and y0
  F w;       // distance along the view
};

}  // namespace gsv::rendering::raster
