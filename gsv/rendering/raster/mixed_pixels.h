// The surfaces of a vector of pixels, each of which may see another triangle.
//
// Method  The planes of all triangles are collected in the lanes that see them, and then computed
//         once. Materials are computed once for each item.
#pragma once

#include "gsv/rendering/raster/surface.h"

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
};

// Texture coordinates in the lanes that see triangles with textures.
template <class F>
struct TextureLanes {
  PlaneLanes<F> for_w, for_u, for_v;
  F u, v;
  // The middle of those pixels of a group that see the triangle, relative to its x0, and the distance
  // of the pixels from its y0.
  F middle, dy;
};

// The planes of the triangles that the pixels of a vector see. To stay in registers, it has no arrays,
// and must not be passed to functions.
template <class F>
class SeenPlanes {
 public:
  using Mask = typename Lanes<F>::Mask;

  explicit SeenPlanes(const Pixels<F>& pixels)
      : columns_(pixels.ColumnsFrom(0)), rows_(pixels.RowsFrom(0)) {}

  // Sets the triangle of the lanes of `mask`. The pixels `seen` see it (a bit for each lane).
  __attribute__((always_inline)) void Set(Mask mask, const TriangleSurface& s, bool has_textures,
                                          int seen) {
    Set(mask, x0_, s.x0);
    Set(mask, y0_, s.y0);
    Set(mask, w_, s, TriangleSurface::kInverseW);
    Set(mask, normal_x_, s, TriangleSurface::kNormalX);
    Set(mask, normal_y_, s, TriangleSurface::kNormalY);
    Set(mask, normal_z_, s, TriangleSurface::kNormalZ);
    number_ = SelectInt(mask, SplatInt<F>(s.number), number_);
    if (!has_textures) return;
    has_textures_ = true;
    Set(mask, u_, s, TriangleSurface::kU);
    Set(mask, v_, s, TriangleSurface::kV);
    middle_ = Select(mask, ByGroup<F>(MiddlesOf<F>(seen)), middle_);
  }

  // Sets w, the normals and the numbers of `s`, and the texture coordinates if a triangle has
  // textures.
  void Compute(Surfaces<F>& s, TextureLanes<F>& textures) const {
    const F dx = columns_ - x0_, dy = rows_ - y0_;
    const auto at = [&](const PlaneLanes<F>& p) { return Fma(p.a, dx, p.c + p.b * dy); };
    s.w = Splat<F>(1) / at(w_);
    s.normal = {at(normal_x_), at(normal_y_), at(normal_z_)};
    s.number = number_;
    if (!has_textures_) return;
    textures = {w_, u_, v_, at(u_) * s.w, at(v_) * s.w, columns_ - Steps<F>() - x0_ + middle_, dy};
  }

 private:
  __attribute__((always_inline)) static void Set(Mask mask, F& lanes, float value) {
    lanes = Select(mask, Splat<F>(value), lanes);
  }
  __attribute__((always_inline)) static void Set(Mask mask, PlaneLanes<F>& lanes,
                                                 const TriangleSurface& s,
                                                 TriangleSurface::Plane i) {
    Set(mask, lanes.a, s.a[i]);
    Set(mask, lanes.b, s.b[i]);
    Set(mask, lanes.c, s.c[i]);
  }

  F columns_, rows_;
  F x0_{}, y0_{};  // the origins of the triangles
  PlaneLanes<F> w_{}, normal_x_{}, normal_y_{}, normal_z_{};
  typename Lanes<F>::Ints number_{};
  bool has_textures_ = false;
  PlaneLanes<F> u_{}, v_{};
  F middle_{};  // see MiddlesOf()
};

inline bool HasTextures(const DrawGroup& group) {
  return group.base_colour || group.normal || group.metallic_roughness || group.emissive ||
         group.occlusion || group.light;
}

// The items that the pixels of a vector see.
template <class F>
class SeenItems {
 public:
  using Mask = typename Lanes<F>::Mask;
  static constexpr int kLanes = Lanes<F>::kCount;

  // Sets the triangle of the lanes of `mask`. There may be one triangle for each lane.
  void Set(Mask mask, const Drawn& drawn, const Triangle& t) {
    triangles_[count_++] = {&drawn, &t, mask};
    int at = part_count_;
    for (int i = 0; i < part_count_; ++i) {
      if (parts_[i].drawn == &drawn) at = i;
      parts_[i].mask = parts_[i].mask & ~mask;
    }
    if (at == part_count_) parts_[part_count_++] = {&drawn, mask};
    parts_[at].mask = parts_[at].mask | mask;
  }

  // Sets the properties of the materials, and turns normals towards the camera. `ray` is the direction
  // of each pixel, with the component 1 along the view.
  void Compute(const TextureLanes<F>& textures, const Three<F>& ray, Surfaces<F>& s) const {
    for (int i = 0; i < part_count_; ++i) {
      if (!parts_[i].drawn->group->double_sided) continue;
      const Mask turned = parts_[i].mask & Less(Splat<F>(0), Dot(s.normal, ray));
      s.normal = Select(turned, s.normal * Splat<F>(-1), s.normal);
    }
    for (int i = 0; i < part_count_; ++i) AddMaterial(parts_[i], i == 0, textures, s);
  }

 private:
  // The lanes that see an item.
  struct Part {
    const Drawn* drawn;
    Mask mask;
  };
  // The lanes that see a triangle. Later triangles may have taken some of them.
  struct Seen {
    const Drawn* drawn;
    const Triangle* triangle;
    Mask mask;
  };

  // Sets the properties of the material of an item, in all lanes for the first item.
  void AddMaterial(const Part& part, bool is_first, const TextureLanes<F>& at,
                   Surfaces<F>& s) const {
    const DrawGroup& group = *part.drawn->group;
    const SurfaceFactors& f = *part.drawn->factors;
    Three<F> base = Splat<F>(f.base_colour[0], f.base_colour[1], f.base_colour[2]);
    Three<F> emissive =
        Splat<F>(f.emissive_metalness[0], f.emissive_metalness[1], f.emissive_metalness[2]);
    F alpha = Splat<F>(f.base_colour[3]), metalness = Splat<F>(f.emissive_metalness[3]),
      roughness = Splat<F>(f.roughness), occlusion = Splat<F>(1);
    const auto look = [&](const std::shared_ptr<const DrawTexture>& texture) {
      const auto& of = static_cast<const RasterTexture&>(*texture);
      const F levels = LevelsAt<F>(at.for_w, at.for_u, at.for_v, at.middle, at.dy, of);
      return Sample(of, MipLevels<F>(of, levels), at.u, at.v, part.mask);
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
      s.normal =
          Select(part.mask, Bumped(part, look(group.normal), Normalized(s.face_normal)), s.normal);
    }
    if (is_first) {
      s.base = base, s.emissive = emissive, s.alpha = alpha, s.metalness = metalness;
      s.roughness = roughness, s.occlusion = occlusion;
      return;
    }
    s.base = Select(part.mask, base, s.base);
    s.emissive = Select(part.mask, emissive, s.emissive);
    s.alpha = Select(part.mask, alpha, s.alpha);
    s.metalness = Select(part.mask, metalness, s.metalness);
    s.roughness = Select(part.mask, roughness, s.roughness);
    s.occlusion = Select(part.mask, occlusion, s.occlusion);
  }

  // Applies the normal map of an item to its normals `n`, in a frame along the texture's axes. v runs
  // downwards.
  Three<F> Bumped(const Part& part, const Texels<F>& bump, const Three<F>& n) const {
    Three<F> right = Splat<F>(0, 0, 0), down = right;
    Mask has_axes = MaskOf<F>(0);
    for (int i = 0; i < count_; ++i) {
      const auto& [drawn, triangle, mask] = triangles_[i];
      if (drawn != part.drawn) continue;
      const BumpAxes axes = BumpAxesOf(*part.drawn, *triangle);
      has_axes = axes.is_valid ? has_axes | mask : has_axes & ~mask;
      if (!axes.is_valid) continue;
      right = Select(mask, Splat<F>(axes.right[0], axes.right[1], axes.right[2]), right);
      down = Select(mask, Splat<F>(axes.down[0], axes.down[1], axes.down[2]), down);
    }
    const auto centred = [](F value) { return Fma(value, Splat<F>(2), Splat<F>(-1)); };
    return Select(
        has_axes,
        Normalized(right * centred(bump.r) - down * centred(bump.g) + n * centred(bump.b)), n);
  }

  Seen triangles_[kLanes];
  int count_ = 0;
  Part parts_[kLanes];
  int part_count_ = 0;
};

}  // namespace gsv::rendering::raster
