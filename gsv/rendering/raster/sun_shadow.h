// The shadow map of the sun: one per snapshot, for all cameras.
//
// Static shadow casters are drawn once, into a first map. A second map also contains the moving
// casters. For each snapshot, the changed parts of the second map are copied from the first map,
// and those moving casters are drawn again whose shadows a camera may see.
//
// Threads      Draw() needs exclusive access; const members may run concurrently.
// Determinism  the map is bit-identical for any number of threads.
#pragma once

#include <span>
#include <vector>

#include "gsv/base/thread_team.h"
#include "gsv/rendering/raster/rasteriser.h"
#include "gsv/rendering/raster/shadow_bounds.h"
#include "gsv/rendering/scene/shadow_region.h"

namespace gsv::rendering::raster {

// The shadow map of the sun in memory.
class SunShadow {
 public:
  // Draws the shadow map of a posed render list for some cameras, on the threads of `team`.
  // `render_list_id` identifies the render list.
  void Draw(const RenderList& render_list, std::uint64_t render_list_id,
            const geometry::Vector3& to_sun, const std::vector<CameraView>& views,
            base::ThreadTeam& team);

  const ShadowRegion& region() const { return region_; }
  // The parts of the map that contain shadows of moving casters.
  const std::vector<ShadowRegion::Rectangle>& moved() const { return moved_; }

  // The fraction of sunlight that reaches points of the map. x and y are from 0 to 1 across the
  // map, and z grows towards the sun. The fraction is 1 outside the map. Lanes outside `needed` get
  // any value in [0, 1].
  template <class F>
  F Visible(const Three<F>& point, typename Lanes<F>::Mask needed) const {
    const F side = Splat<F>(kShadowSide);
    // Points outside the map use the border texels, which cast no shadow.
    const auto inside = [&](F at) { return Min(Max(at, Splat<F>(-0.5f)), side + Splat<F>(0.4f)); };
    const F x = point.x * side, y = point.y * side;
    // The cleared map has depth 0, so no point may be below 0.
    const F z = Max(point.z, Splat<F>(0));
    const ShadowBounds::Range<F> range = bounds_.At(x, y);
    const auto is_lit = AtLeast(z, range.max), is_shaded = Less(z, range.min);
    const auto open = AnyOfEight(needed & ~(is_lit | is_shaded));
    const F bound = Select(is_lit, Splat<F>(1), Splat<F>(0));
    if (!Any(open)) return bound;
    const F first = Lit(inside(x - Splat<F>(0.6f)), inside(y - Splat<F>(0.3f)), z);
    const F second = Lit(inside(x + Splat<F>(0.6f)), inside(y + Splat<F>(0.3f)), z);
    const F found = Splat<F>(0.5f) * (first + second);
    return Lanes<F>::kCount == 8 ? found : Select(open, found, bound);
  }

 private:
  struct Drawn {
    std::uint64_t render_list_id = 0;
    int moved_count = -1;
    ShadowRegion region;
    friend bool operator==(const Drawn&, const Drawn&) = default;
  };

  // A caster that is ready to be drawn.
  struct Caster {
    raster::Drawn drawn;  // the caster's mesh, and its pose in the world
    float depth_row[4];   // computes the depth in the map from a mesh vertex
    bool both_sides = false;
    ShadowRegion::Rectangle around;  // the texels that the caster may cover
  };
  // A run of rows of the map, [begin, end). Threads draw different bands.
  struct Band {
    int begin = 0, end = 0;
  };

  // Copies the part of still_ that is in a band to moving_.
  void CopyStill(const ShadowRegion::Rectangle& part, const Band& band);
  // Returns the casters that are large enough to cast a shadow. Robots are drawn with front faces
  // and coarser levels only. This suffices for closed meshes.
  std::vector<Caster> CastersOf(const RenderList& render_list,
                                const std::vector<std::size_t>& items,
                                const std::array<float, 16>& shadow_from_relative) const;
  // Copies parts of still_ to moving_, if `map` is moving_, and draws casters into `map`.
  void DrawCasters(const RenderList& render_list, const std::vector<std::size_t>& items,
                   std::span<const ShadowRegion::Rectangle> copied, std::vector<float>& map,
                   base::ThreadTeam& team);
  // Draws the part of a caster that is in a band.
  static void DrawCaster(const Caster& caster, const Band& band, Rasteriser& rasteriser,
                         std::vector<float>& map);
  // Returns the fraction of sunlight at a depth z, interpolated between the four nearest texels.
  template <class F>
  F Lit(F x, F y, F z) const {
    // The centre of texel (0, 0) is at 0.5.
    const F px = x - Splat<F>(0.5f), py = y - Splat<F>(0.5f);
    const F whole_x = Floor(px), whole_y = Floor(py);
    const F fx = px - whole_x, fy = py - whole_y;
    const auto at = (Truncated(whole_y) + 1) * SplatInt<F>(kStride) + Truncated(whole_x) + 1;
    const float* map = moving_.data();
    const auto row = [&](int offset) {
      const auto depths = GatherPairs(map + offset, at);
      const F left = Select(AtLeast(z, (F)depths.first), Splat<F>(1), Splat<F>(0));
      const F right = Select(AtLeast(z, (F)depths.second), Splat<F>(1), Splat<F>(0));
      return Fma(right - left, fx, left);
    };
    const F top = row(0), bottom = row(kStride);
    return Fma(bottom - top, fy, top);
  }

  static constexpr int kStride = kShadowSide + 16;
  static constexpr int kFirst = kStride + 1;  // index of texel (0, 0) of the map without its border

  std::vector<float> still_,
      moving_;  // kStride texels per row, with a border of one texel that casts no shadow
  ShadowRegion region_;
  Drawn drawn_;                                 // the present content of still_
  std::vector<ShadowRegion::Rectangle> moved_;  // the parts in which moving_ differs from still_
  ShadowBounds bounds_;                         // bounds of the depths in moving_
  std::vector<Rasteriser> rasterisers_;         // one for each thread
};

}  // namespace gsv::rendering::raster
