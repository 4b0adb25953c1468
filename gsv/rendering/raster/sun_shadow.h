// The shadow map of the sun: one per snapshot, for all cameras.
//
// Static shadow casters are drawn once, into a first map. A second map contains the moving casters
// as well. For each snapshot, the changed parts of the second map are restored from the first one
// and drawn again, if a camera may see the shadows.
// Threads  Draw() needs exclusive access; const members may run concurrently.
#pragma once

#include <vector>

#include "gsv/rendering/raster/rasteriser.h"
#include "gsv/rendering/raster/shadow_bounds.h"
#include "gsv/rendering/scene/shadow_region.h"

namespace gsv::rendering::raster {

// The shadow map of the sun in memory.
class SunShadow {
 public:
  // Draws the shadow map of a posed render list for some cameras. `render_list_id` identifies the
  // render list.
  void Draw(const RenderList& render_list, std::uint64_t render_list_id,
            const geometry::Vector3& to_sun, const std::vector<CameraView>& views);

  const ShadowRegion& region() const { return region_; }
  // The parts of the map that contain shadows of moving casters.
  const std::vector<ShadowRegion::Rectangle>& moved() const { return moved_; }

  // The fraction of sunlight that reaches points of the map. x and y are from 0 to 1 across the
  // map, and z grows towards the sun. The fraction is 1 outside the map. Lanes outside `needed` get
  // any value in [0, 1].
  F8 Visible(const F8x3& point, I8 needed) const;

 private:
  struct Drawn {
    std::uint64_t render_list_id = 0;
    int moved_count = -1;
    ShadowRegion region;
    friend bool operator==(const Drawn&, const Drawn&) = default;
  };

  // Copies a part of still_ to moving_.
  void CopyStill(const ShadowRegion::Rectangle& part);
  // Draws casters into a map. Moving casters are drawn with front faces and coarser levels only,
  // which suffices for closed meshes.
  void DrawCasters(const RenderList& render_list, const std::vector<std::size_t>& casters,
                   std::vector<float>& map);
  // Draws one caster into a map.
  void DrawCaster(const raster::Drawn& caster, const float (&depth_row)[4], bool both_sides,
                  std::vector<float>& map);
  // Returns the fraction of sunlight at a depth z, interpolated between the four nearest texels.
  F8 Lit(F8 x, F8 y, F8 z) const;

  std::vector<float> still_,
      moving_;  // kStride texels per row, with a border of one texel that casts no shadow
  ShadowRegion region_;
  Drawn drawn_;                                 // the present content of still_
  std::vector<ShadowRegion::Rectangle> moved_;  // the parts in which moving_ differs from still_
  ShadowBounds bounds_;                         // bounds of the depths in moving_
  Rasteriser rasteriser_;
};

}  // namespace gsv::rendering::raster
