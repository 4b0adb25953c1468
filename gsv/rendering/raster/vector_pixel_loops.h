// The loops over pixels, for vectors of any number of lanes.
#pragma once

#include <optional>

#include "gsv/rendering/raster/lighting.h"
#include "gsv/rendering/raster/mixed_pixels.h"
#include "gsv/rendering/raster/pixel_loops.h"
#include "gsv/rendering/raster/scan.h"

namespace gsv::rendering::raster {

// The loops for vectors of type F (F8 or F16, see simd.h).
template <class F>
class VectorPixelLoops final : public PixelLoops {
  using Ints = typename Lanes<F>::Ints;
  using Mask = typename Lanes<F>::Mask;
  static constexpr int kLanes = Lanes<F>::kCount, kGroups = Lanes<F>::kGroups;

 public:
  void Begin(const ImageInProgress& image) override { image_ = image; }

  bool Cover(const Drawn& drawn, const Triangle& t, const Box& box, bool crosses_near,
             std::uint32_t id, float back) override {
    const bool has_holes =
        drawn.group->blending == Blending::kAlphaMask && drawn.group->base_colour != nullptr;
    return has_holes ? CoverAs<true>(drawn, t, box, crosses_near, id, back)
                     : CoverAs<false>(drawn, t, box, crosses_near, id, back);
  }

  void BeginShading(const VisibleTriangles& visible, const FrameBlock& block,
                    const SunShadow* shadow) override {
    visible_ = visible;
    light_.emplace(block, shadow);
    surface_of_.assign(visible.triangles.size(), -1);
    material_of_.assign(visible.drawn.size(), -1);
    surfaces_.clear();
    materials_.clear();
  }

  TileToShade TileAt(int x0, int y0, int x1, int y1) const override {
    F max_lanes = Splat<F>(0), min_lanes = Splat<F>(1e30f);  // the extremes of 1/w in the tile
    for (int y = y0; y < y1; y += kGroups) {
      for (int x = x0; x < x1; x += 8) {
        const Places<F> at = PixelsAt(x, y).In(Stride());
        const Mask seen = ~EqualInt(LoadGroupInts<F>(image_.nearest, at), SplatInt<F>(0)) &
                          MaskOf<F>(Inside(x1 - x, y1 - y));
        const F inverse_w = LoadGroups<F>(image_.inverse_w, at);
        max_lanes = Max(max_lanes, Select(seen, inverse_w, max_lanes));
        min_lanes = Min(min_lanes, Select(seen, inverse_w, min_lanes));
      }
    }
    const float max_inverse_w = MaxOf(max_lanes), min_inverse_w = MinOf(min_lanes);
    if (max_inverse_w == 0) return {x0, y0, x1, y1, true, {}, {}};
    // The box around the eight corners of the view's part that the tile shows.
    const double min_w = 1 / static_cast<double>(max_inverse_w);
    const double max_w = 1 / static_cast<double>(min_inverse_w);
    double min[3], max[3];
    for (std::size_t i = 0; i < 3; ++i) {
      const double ahead = image_.forward[i], right = image_.right[i], down = image_.down[i];
      const auto [left_x, right_x] = std::minmax({right * (x0 - 0.5), right * (x1 - 0.5)});
      const auto [upper_y, lower_y] = std::minmax({down * (y0 - 0.5), down * (y1 - 0.5)});
      const double low = ahead + left_x + upper_y, high = ahead + right_x + lower_y;
      min[i] = std::min(low * min_w, low * max_w);
      max[i] = std::max(high * min_w, high * max_w);
    }
    return {x0, y0, x1, y1, false, {min[0], min[1], min[2]}, {max[0], max[1], max[2]}};
  }

  void Shade(const TileToShade& tile) override {
    const Lamps<F> lamps = tile.is_empty ? Lamps<F>() : light_->Reaching(tile.min, tile.max);
    for (int y = tile.y0; y < tile.y1; y += kGroups) {
      for (int x = tile.x0; x < tile.x1;) {
        const int vectors = ShadeRun(lamps, x, y, tile.x1);
        if (vectors == 0) Shade(lamps, x, y);
        x += 8 * std::max(vectors, 1);
      }
    }
  }

  void BeginBlending(const Drawn& drawn, const geometry::Vector3& centre, double radius) override {
    const geometry::Vector3 to_corner{radius, radius, radius};
    blended_ = &drawn;
    // Most items are so small that few lamps reach them.
    blended_lamps_ = light_->Reaching(centre - to_corner, centre + to_corner);
  }

  void Blend(const Triangle& t, const Box& box) override {
    const TriangleSurface surface = SurfaceOf(*blended_, t);
    const F near = Splat<F>(image_.nearest_inverse_w);
    Scan<F>(t, box, [&](const Pixels<F>& pixels, Mask covered, F inverse_w) {
      const Mask visible = covered &
                           Less(pixels.ColumnsFrom(0), Splat<F>(static_cast<float>(image_.width))) &
                           AtLeast(near, inverse_w) &
                           Less(LoadGroups<F>(image_.inverse_w, pixels.In(Stride())), inverse_w);
      const int seen = Bits(visible);
      if (seen == 0) return;
      const Three<F> ray = RaysOf(pixels);
      SeenPlanes<F> planes(pixels);
      SeenItems<F> items;
      planes.Set(MaskOf<F>(kAll), surface, HasTextures(*blended_->group), seen);
      items.Set(MaskOf<F>(kAll), *blended_, t);
      const Surfaces<F> surfaces = SurfacesOf(planes, items, ray);
      const Ints above =
          Encoded(values_, light_->Colour(surfaces, ray, blended_lamps_, visible), SplatInt<F>(0));
      Places<F> to{};  // groups without visible pixels may be outside of the image
      for (int i = 0; i < kGroups; ++i) {
        if ((seen >> 8 * i & 0xff) == 0) continue;
        const int x = pixels.x[i], y = pixels.y[i];
        MarkBlended(x, y), MarkBlended(std::min(x + 8, image_.width) - 1, y);
        to.of[i] = pixels.In(static_cast<std::size_t>(image_.width)).of[i];
      }
      const Ints below = LoadGroupInts<F>(image_.rgba, to);
      // The alpha channel keeps the number of the opaque surface.
      Ints mixed = below & SplatInt<F>(static_cast<std::int32_t>(0xff000000u));
      for (int shift = 0; shift < 24; shift += 8) {
        const F a = ToFloat((above >> shift) & SplatInt<F>(0xff)),
                b = ToFloat((below >> shift) & SplatInt<F>(0xff));
        mixed |= Truncated(Fma(a - b, surfaces.alpha, b + Splat<F>(0.5f))) << shift;
      }
      StoreGroupInts(visible, image_.rgba, to, mixed);
    });
  }

 private:
  // See Cover(). kHoles says whether the item has a texture with holes.
  template <bool kHoles>
  bool CoverAs(const Drawn& drawn, const Triangle& t, const Box& box, bool crosses_near,
               std::uint32_t id, float back) {
    const F factor = Splat<F>(back), max = Splat<F>(image_.nearest_inverse_w);
    const Ints number = SplatInt<F>(static_cast<std::int32_t>(id));
    float* const depths = image_.inverse_w;
    std::uint32_t* const nearest = image_.nearest;
    const auto stride = static_cast<std::size_t>(image_.stride);
    bool is_seen = false;
    Scan<F>(t, box, [&](const Pixels<F>& pixels, Mask covered, F inverse_w) {
      const Places<F> at = pixels.In(stride);
      const F old = LoadGroups<F>(depths, at), moved = inverse_w * factor;
      Mask visible = covered & Less(old, moved);
      if (crosses_near) visible = visible & AtLeast(max, inverse_w);
      if (!Any(visible)) return;
      if (kHoles) {
        const auto& holes = static_cast<const RasterTexture&>(*drawn.group->base_colour);
        visible =
            visible & Solid(t, *drawn.mesh, holes, pixels.ColumnsFrom(t.x0), pixels.RowsFrom(t.y0));
      }
      StoreGroups(visible, depths, at, moved);
      StoreGroupInts(visible, nearest, at, number);
      is_seen = true;
    });
    return is_seen;
  }

  // The numbers of the triangles that the pixels of a vector see.
  struct Ids {
    Ids(const std::uint32_t* nearest, const Places<F>& at) : all(LoadGroupInts<F>(nearest, at)) {
      StoreAllGroups(of, Consecutive(), all);
    }
    // Returns the number in the lowest of these lanes. At least one must be set.
    std::uint32_t FirstOf(int lanes) const {
      return of[__builtin_ctz(static_cast<unsigned>(lanes))];
    }
    // Returns the lanes that see triangle number `id`.
    int LanesOf(std::uint32_t id) const {
      return Bits(EqualInt(all, SplatInt<F>(static_cast<std::int32_t>(id))));
    }

    Ints all;
    alignas(64) std::uint32_t of[kLanes];
  };
  // The places of the groups of a vector in an array with an element for each lane.
  static Places<F> Consecutive() {
    Places<F> places;
    for (int i = 0; i < kGroups; ++i) places.of[i] = static_cast<std::size_t>(8 * i);
    return places;
  }

  // The surface of a triangle. If the material is even and the normal constant, the last members are
  // set.
  struct alignas(64) Surface {
    TriangleSurface triangle;
    const Triangle* of = nullptr;
    const Drawn* drawn = nullptr;
    bool has_textures = false;
    bool is_even = false;
    std::int32_t material = 0;           // index in materials_
    float normal[3], around[3], to_sun;  // see Facing

    Facing<F> facing() const {
      return {Splat<F>(normal[0], normal[1], normal[2]), Splat<F>(around[0], around[1], around[2]),
              Splat<F>(to_sun)};
    }
  };

  // Returns the surface of triangle number `id`.
  const Surface& SurfaceFor(std::uint32_t id) {
    std::int32_t& place = surface_of_[id - 1];
    if (place >= 0) return surfaces_[static_cast<std::size_t>(place)];
    place = static_cast<std::int32_t>(surfaces_.size());
    return AddSurface(visible_.triangles[id - 1]);
  }

  // Appends the surface of a triangle to surfaces_. The result is valid until the next call.
  __attribute__((noinline)) const Surface& AddSurface(const Triangle& triangle) {
    const Drawn& drawn = visible_.drawn[triangle.drawn];
    Surface& surface = surfaces_.emplace_back();
    surface.triangle = SurfaceOf(drawn, triangle);
    surface.of = &triangle, surface.drawn = &drawn;
    surface.has_textures = HasTextures(*drawn.group);
    if (!surface.triangle.is_flat || !IsEven(*drawn.group)) return surface;
    surface.is_even = true;
    const float* normal = surface.triangle.c + TriangleSurface::kNormalX;
    const Facing<F> facing =
        light_->FacingOf(Normalized(Splat<F>(normal[0], normal[1], normal[2])));
    const auto& [n, around, to_sun] = facing;
    surface.normal[0] = n.x[0], surface.normal[1] = n.y[0], surface.normal[2] = n.z[0];
    surface.around[0] = around.x[0], surface.around[1] = around.y[0];
    surface.around[2] = around.z[0];
    surface.to_sun = to_sun[0];
    std::int32_t& material = material_of_[triangle.drawn];
    if (material < 0) {
      material = static_cast<std::int32_t>(materials_.size());
      materials_.emplace_back(drawn);
    }
    surface.material = material;
    return surface;
  }

  // Returns how many vectors from (x, y) on, and before column `end`, see only triangle number `id`.
  int VectorsOf(std::uint32_t id, int x, int y, int end) const {
    const Ints wanted = SplatInt<F>(static_cast<std::int32_t>(id));
    int count = 0;
    for (; x + 8 <= end; x += 8, ++count) {
      const Ints ids = LoadGroupInts<F>(image_.nearest, PixelsAt(x, y).In(Stride()));
      if (Bits(EqualInt(ids, wanted)) != kAll) break;
    }
    return count;
  }

  // Shades the vectors from (x, y) on, and before column `end` of a tile, that see only one triangle.
  // Its material must be even. Returns the number of these vectors, 0 if there are none.
  int ShadeRun(const Lamps<F>& lamps, int x, int y, int end) {
    const std::uint32_t id =
        image_.nearest[static_cast<std::size_t>(y) * Stride() + static_cast<std::size_t>(x)];
    const int count = id == 0 ? 0 : VectorsOf(id, x, y, end);
    if (count == 0) return 0;
    const Surface& surface = SurfaceFor(id);
    if (!surface.is_even) return 0;
    const TriangleSurface& triangle = surface.triangle;
    const EvenMaterial<F>& material = materials_[static_cast<std::size_t>(surface.material)];
    const Facing<F> facing = surface.facing();
    const MipLevels<F8> levels = material.texture == nullptr
                                     ? MipLevels<F8>(SplatInt(0), Splat(0))
                                     : RunLevels(triangle, x, y, *material.texture);
    const Mask all = MaskOf<F>(kAll);
    for (int i = 0; i < count; ++i) {
      const Pixels<F> pixels = PixelsAt(x + 8 * i, y);
      const Three<F> ray = RaysOf(pixels);
      const SeenPixels<F> seen(triangle, pixels);
      const auto lit = [&](const Reflector<F>& reflector) {
        return light_->Colour(reflector, material.gloss, facing, facing.normal, seen.w, ray, lamps,
                              all);
      };
      Three<F> colour;
      if (material.texture == nullptr) {
        colour = lit(material.reflector);
      } else {
        const Three<F> texel = Decoded(seen.Look(*material.texture, levels, kGroups * i));
        colour =
            lit(Reflector<F>(material.base * texel, material.metalness, material.reflector.emissive,
                             material.reflector.occlusion, material.reflector.is_grey));
      }
      StoreAllGroups(image_.rgba, pixels.In(static_cast<std::size_t>(image_.width)),
                     Encoded(values_, colour, SplatInt<F>(triangle.number)));
    }
    return count;
  }

  // Returns the levels of detail of a texture for the groups of the vectors of a tile from (x, y) on,
  // all of whose pixels see the triangle.
  static MipLevels<F8> RunLevels(const TriangleSurface& triangle, int x, int y,
                                 const RasterTexture& texture) {
    static_assert(kTileWidth / 8 * kGroups <= 8);
    const F8 vector = Floor(Steps() * Splat(1.0f / kGroups));
    const F8 row = Steps() - vector * Splat(kGroups);
    // The middle of a group is 3.5 pixels to the right of its first pixel.
    const F8 dx = vector * Splat(8) + Splat(static_cast<float>(x) - triangle.x0 + 3.5f);
    const F8 dy = row + Splat(static_cast<float>(y) - triangle.y0);
    const auto plane = [&](TriangleSurface::Plane i) { return PlaneLanes<F8>(triangle, i); };
    return {texture, LevelsAt<F8>(plane(TriangleSurface::kInverseW), plane(TriangleSurface::kU),
                                  plane(TriangleSurface::kV), dx, dy, texture)};
  }

  // Shades the pixels of a vector that begins at (x, y).
  void Shade(const Lamps<F>& lamps, int x, int y) {
    const Pixels<F> pixels = PixelsAt(x, y);
    const Ids ids(image_.nearest, pixels.In(Stride()));
    const Three<F> ray = RaysOf(pixels);
    const int in_image = Inside(image_.width - x, image_.height - y);
    const Mask is_sky = EqualInt(ids.all, SplatInt<F>(0));
    const Mask used = ~is_sky & MaskOf<F>(in_image);
    const int seen = Bits(used);
    Three<F> colour = Splat<F>(0, 0, 0);
    Ints number = SplatInt<F>(0);
    if (seen != 0) colour = MixedColour(ids, seen, pixels, ray, lamps, used, number);
    if (seen != in_image) colour = Select(is_sky, light_->Sky(ray), colour);
    const Ints rgba = Encoded(values_, colour, SelectInt(is_sky, SplatInt<F>(0), number));
    const Places<F> to = pixels.In(static_cast<std::size_t>(image_.width));
    if (in_image == kAll) {
      StoreAllGroups(image_.rgba, to, rgba);
    } else {
      // The last pixels of a row: the next row must not be written, not even with its own values,
      // because another thread may draw it now.
      std::uint32_t last[kLanes];
      StoreAllGroups(last, Consecutive(), rgba);
      for (int left = in_image; left != 0; left &= left - 1) {
        const int lane = __builtin_ctz(static_cast<unsigned>(left));
        image_.rgba[to.of[lane / 8] + static_cast<std::size_t>(lane % 8)] = last[lane];
      }
    }
  }

  // Returns the colours of pixels that see any triangles, and sets the numbers of their surfaces.
  Three<F> MixedColour(const Ids& ids, int seen, const Pixels<F>& pixels, const Three<F>& ray,
                       const Lamps<F>& lamps, Mask used, Ints& number) {
    SeenPlanes<F> planes(pixels);
    SeenItems<F> items;
    bool is_first = true;
    for (int left = seen; left != 0;) {
      const std::uint32_t id = ids.FirstOf(left);
      const int lanes = ids.LanesOf(id);
      const Surface& surface = SurfaceFor(id);
      // The first triangle fills all lanes, so that the other lanes have valid values.
      const Mask mask = MaskOf<F>(is_first ? kAll : WithIdleLanes(lanes, ids, seen, id));
      planes.Set(mask, surface.triangle, surface.has_textures, lanes);
      items.Set(mask, *surface.drawn, *surface.of);
      is_first = false;
      left &= ~lanes;
    }
    const Surfaces<F> surfaces = SurfacesOf(planes, items, ray);
    number = surfaces.number;
    return light_->Colour(surfaces, ray, lamps, used);
  }

  // Returns the surfaces of pixels that see these triangles of these items.
  __attribute__((always_inline)) static Surfaces<F> SurfacesOf(const SeenPlanes<F>& planes,
                                                               const SeenItems<F>& items,
                                                               const Three<F>& ray) {
    Surfaces<F> surfaces;
    TextureLanes<F> textures;
    planes.Compute(surfaces, textures);
    items.Compute(textures, ray, surfaces);
    return surfaces;
  }

  // Adds the lanes that see nothing to the lanes that see triangle number `id`, in those groups in
  // which it is the first triangle. So a group has the same values as if it were shaded alone (see
  // LightModel::AddLamp()).
  static int WithIdleLanes(int lanes, const Ids& ids, int seen, std::uint32_t id) {
    for (int first = 0; first < kLanes; first += 8) {
      const int in_group = seen & 0xff << first;
      if (in_group == 0 || ids.FirstOf(in_group) != id) continue;
      lanes |= ~seen & 0xff << first;
    }
    return lanes;
  }

  // The vector that begins at (x, y). Its groups are below each other.
  static Pixels<F> PixelsAt(int x, int y) {
    Pixels<F> pixels;
    for (int i = 0; i < kGroups; ++i) pixels.x[i] = x, pixels.y[i] = y + i;
    return pixels;
  }

  // Returns the lanes of such a vector that are inside an area which has so many columns and rows from
  // its first pixel on.
  static int Inside(int columns, int rows) {
    const int in_group = columns >= 8 ? 0xff : (1 << columns) - 1;
    int lanes = in_group;
    for (int i = 1; i < std::min(kGroups, rows); ++i) lanes |= in_group << 8 * i;
    return lanes;
  }

  // Returns the directions of the rays through the pixels.
  Three<F> RaysOf(const Pixels<F>& pixels) const {
    const F px = pixels.ColumnsFrom(0), py = pixels.RowsFrom(0);
    const auto part = [&](std::size_t i) {
      return Fma(Splat<F>(image_.right[i]), px,
                 Splat<F>(image_.forward[i]) + Splat<F>(image_.down[i]) * py);
    };
    return {part(0), part(1), part(2)};
  }

  static constexpr int kAll = (1 << kLanes) - 1;

  // Notes that a transparent item was blended in the tile of pixel (x, y).
  void MarkBlended(int x, int y) {
    const int columns = (image_.width + kTileWidth - 1) / kTileWidth;
    image_.is_blended[y / kTileHeight * columns + x / kTileWidth] = 1;
  }

  std::size_t Stride() const { return static_cast<std::size_t>(image_.stride); }

  ImageInProgress image_;
  VisibleTriangles visible_;
  const std::uint8_t* const values_ = EncodedValues();
  std::optional<LightModel<F>> light_;
  const Drawn* blended_ = nullptr;  // the transparent item that is blended
  Lamps<F> blended_lamps_;          // the lamps that reach it
  // Element n - 1 is for triangle number n: its index in surfaces_; -1 if it is not there yet.
  std::vector<std::int32_t> surface_of_;
  std::vector<Surface> surfaces_;
  std::vector<std::int32_t> material_of_;  // for each item: its index in materials_, or -1
  std::vector<EvenMaterial<F>> materials_;
};

}  // namespace gsv::rendering::raster
