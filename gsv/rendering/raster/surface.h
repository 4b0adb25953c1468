// Computes the surfaces that the pixels of a vector see.
#pragma once

#include "gsv/rendering/raster/raster_texture.h"
#include "gsv/rendering/raster/rasteriser.h"
#include "gsv/rendering/raster/reflector.h"

namespace gsv::rendering::raster {

// The surfaces at the pixels of a vector, each of which may see another triangle. Colours are
// linear.
template <class F>
struct Surfaces {
  F w;                   // distance along the view
  Three<F> normal;       // points towards the camera and includes the normal map
  Three<F> face_normal;  // does not include the normal map; only set if has_normal_map
  bool has_normal_map = false;
  Three<F> base, emissive;  // base colour and emitted light
  F alpha, metalness, roughness;
  F occlusion;                     // the fraction of ambient light that reaches the surface
  typename Lanes<F>::Ints number;  // number of the surface, from 1 to 255
  // The item whose material all filled lanes have, if the material has no textures; else null.
  const Drawn* plain = nullptr;
};

// The attributes of a triangle's surface as functions of the pixel. The value of a plane at the
// centre of pixel (x, y) is a (x - x0) + b (y - y0) + c. Texture coordinates and normals are
// divided by w, and so are linear.
struct TriangleSurface {
  struct Plane {
    float a, b, c;
    // Returns the values at pixels that are dx and dy away from (x0, y0).
    template <class F>
    F At(F dx, float dy) const {
      return Fma(Splat<F>(a), dx, Splat<F>(c + b * dy));
    }
  };
  Plane inverse_w, u, v;
  Plane normal[3];       // not of unit length, unless the normal is constant
  bool is_flat = false;  // the normal is the constant term c of the planes
  int number = 0;
};

// Computes the attributes of a visible triangle.
TriangleSurface SurfaceOf(const Drawn& drawn, const Triangle& triangle);

// Returns the mip levels at which a texel is about as large as a pixel, for up to four pixels that
// are dx and dy away from the triangle's x0 and y0.
F4 LevelsAt(const TriangleSurface& surface, F4 dx, float dy, const RasterTexture& texture);

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
                              F dx, float dy) {
  const auto q = [&](int i) { return Fma(Splat<F>(t.a[i]), dx, Splat<F>(t.c[i] + t.b[i] * dy)); };
  const F q0 = q(0), q1 = q(1), q2 = q(2);
  const F w = Splat<F>(1) / (q0 + q1 + q2);
  const F second = q1 * w, third = q2 * w;  // the weights of these corners
  const auto between = [&](const std::vector<float>& values) {
    const float v0 = values[t.corner[0]];
    return Fma(Splat<F>(values[t.corner[1]] - v0), second,
               Fma(Splat<F>(values[t.corner[2]] - v0), third, Splat<F>(v0)));
  };
  const float finest[MipLevels<F>::kGroups] = {};
  return AtLeast(Sample(holes, MipLevels<F>(holes, finest), between(mesh.u), between(mesh.v)).a,
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

// Pixels from (x, y) to the right that see a triangle.
template <class F>
struct SeenPixels {
  SeenPixels(const Triangle& of, const TriangleSurface& its_surface, int x, int y, int lanes)
      : triangle(of),
        surface(its_surface),
        seen(lanes),
        first_dx(static_cast<float>(x) - of.x0),
        dx(Splat<F>(first_dx) + Steps<F>()),
        dy(static_cast<float>(y) - of.y0),
        w(Splat<F>(1) / its_surface.inverse_w.At(dx, dy)) {}

  // Looks up a texture at the pixels. Eight pixels have one level of detail: that at the middle of
  // those of them that see the triangle.
  Texels<F> Look(const RasterTexture& texture) const {
    constexpr int kGroups = MipLevels<F>::kGroups;
    F4 middle{};
    for (int i = 0; i < kGroups; ++i) {
      const auto lanes = static_cast<unsigned>(seen >> 8 * i & 0xff);
      // A group that does not see the triangle gets the level of its first pixel. Its colours are not
      // used.
      const auto any = lanes != 0 ? lanes : 1;
      middle[i] = static_cast<float>(8 * i) +
                  0.5f * static_cast<float>(__builtin_ctz(any) + 31 - __builtin_clz(any));
    }
    const F4 at = LevelsAt(surface, first_dx + middle, dy, texture);
    float levels[kGroups];
    for (int i = 0; i < kGroups; ++i) levels[i] = at[i];
    return Sample(texture, MipLevels<F>(texture, levels), surface.u.At(dx, dy) * w,
                  surface.v.At(dx, dy) * w);
  }

  const Triangle& triangle;
  const TriangleSurface& surface;
  int seen;  // a bit for each pixel, set if it sees the triangle; at least one is set
  float first_dx;
  F dx;      // distance from the triangle's x0
  float dy;  // distance from the triangle's y0
  F w;       // distance along the view
};

// Applies the normal map in a frame along the texture's axes. v runs downwards.
template <class F>
Three<F> Bumped(const BumpAxes& axes, const Texels<F>& bump, const Three<F>& n) {
  if (!axes.is_valid) return n;
  const auto centred = [](F value) { return Fma(value, Splat<F>(2), Splat<F>(-1)); };
  return Normalized(Splat<F>(axes.right[0], axes.right[1], axes.right[2]) * centred(bump.r) -
                    Splat<F>(axes.down[0], axes.down[1], axes.down[2]) * centred(bump.g) +
                    n * centred(bump.b));
}

// Fills in the lanes of `mask`, which see a triangle of `drawn`. The first call must fill in all
// lanes. `ray` is the direction of each pixel, with the component 1 along the view.
template <class F>
void FillIn(const Drawn& drawn, const SeenPixels<F>& pixels, typename Lanes<F>::Mask mask,
            bool is_first, const Three<F>& ray, Surfaces<F>& s) {
  const DrawGroup& group = *drawn.group;
  const TriangleSurface& surface = pixels.surface;
  Three<F> n;
  if (surface.is_flat) {
    n = Splat<F>(surface.normal[0].c, surface.normal[1].c, surface.normal[2].c);
  } else {
    n = {surface.normal[0].At(pixels.dx, pixels.dy), surface.normal[1].At(pixels.dx, pixels.dy),
         surface.normal[2].At(pixels.dx, pixels.dy)};
  }
  if (group.double_sided) {
    // Use the normal of the side that the camera sees.
    n = Select(Less(Splat<F>(0), Dot(n, ray)), n * Splat<F>(-1), n);
  }
  const bool has_textures = group.base_colour || group.normal || group.metallic_roughness ||
                            group.emissive || group.occlusion || group.light;
  if (is_first) {
    s.w = pixels.w, s.normal = n, s.number = SplatInt<F>(surface.number);
    s.has_normal_map = false;
  } else {
    s.w = Select(mask, pixels.w, s.w);
    s.normal = Select(mask, n, s.normal);
    if (s.has_normal_map) s.face_normal = Select(mask, n, s.face_normal);
    s.number = SelectInt(mask, SplatInt<F>(surface.number), s.number);
  }
  if (!is_first && s.plain == &drawn) return;
  s.plain = is_first && !has_textures ? &drawn : nullptr;

  const SurfaceFactors& f = *drawn.factors;
  Three<F> base = Splat<F>(f.base_colour[0], f.base_colour[1], f.base_colour[2]);
  Three<F> emissive =
      Splat<F>(f.emissive_metalness[0], f.emissive_metalness[1], f.emissive_metalness[2]);
  F alpha = Splat<F>(f.base_colour[3]), metalness = Splat<F>(f.emissive_metalness[3]),
    roughness = Splat<F>(f.roughness), occlusion = Splat<F>(1);
  if (has_textures) {
    const auto look = [&](const std::shared_ptr<const DrawTexture>& texture) {
      return pixels.Look(static_cast<const RasterTexture&>(*texture));
    };
    if (group.base_colour) {
      const Texels<F> texel = look(group.base_colour);
      base = base * Decoded(texel);
      alpha = alpha * texel.a;
    }
    if (group.metallic_roughness) {
      const Texels<F> texel = look(group.metallic_roughness);
      metalness = metalness * texel.b;
      roughness = Max(roughness * texel.g, Splat<F>(0.05f));
    }
    if (group.emissive) emissive = emissive * Decoded(look(group.emissive));
    if (group.occlusion) occlusion = look(group.occlusion).r;
    if (group.light) {
      const Three<F> diffuse = base * (Splat<F>(1) - metalness);
      emissive = emissive + Decoded(look(group.light)) * (diffuse * occlusion);
    }
    if (group.normal) {
      if (!s.has_normal_map) s.face_normal = s.normal;
      s.has_normal_map = true;
      const Three<F> bumped =
          Bumped(BumpAxesOf(drawn, pixels.triangle), look(group.normal), Normalized(n));
      s.normal = is_first ? bumped : Select(mask, bumped, s.normal);
    }
  }
  if (is_first) {
    s.base = base, s.emissive = emissive, s.alpha = alpha, s.metalness = metalness;
    s.roughness = roughness, s.occlusion = occlusion;
    return;
  }
  s.base = Select(mask, base, s.base);
  s.emissive = Select(mask, emissive, s.emissive);
  s.alpha = Select(mask, alpha, s.alpha);
  s.metalness = Select(mask, metalness, s.metalness);
  s.roughness = Select(mask, roughness, s.roughness);
  s.occlusion = Select(mask, occlusion, s.occlusion);
}

}  // namespace gsv::rendering::raster
