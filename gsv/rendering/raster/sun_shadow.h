// The depth of the world as the sun sees it: one for each snapshot, whatever cameras look.
//
// What casts shadows and has not moved is drawn once. A second map has what moves as well; for each
// snapshot it is mended from the first where something moved and gets its new place, as far as the
// pictures' cameras may see the shadow of what moves.
// Threads  Draw() alone; const members any number at once.
#pragma once

#include <vector>

#include "gsv/rendering/raster/rasteriser.h"
#include "gsv/rendering/scene/shadow_region.h"

namespace gsv::rendering::raster {

class SunShadow {
 public:
  // Draws the shadows of a posed plan for some cameras. `render_list_id` tells plans apart.
  void Draw(const RenderList& render_list, std::uint64_t render_list_id,
            const geometry::Vector3& to_sun, const std::vector<CameraView>& views);

  const ShadowRegion& region() const { return region_; }

  // The share of the sun that reaches points of the map, from its corner and in its sides; z grows
  // towards the sun. Outside the map everything is in the sun.
  F8 Visible(const F8x3& point) const;

 private:
  struct Drawn {
    std::uint64_t render_list_id = 0;
    int moved_count = -1;
    ShadowRegion region;
    friend bool operator==(const Drawn&, const Drawn&) = default;
  };

  void CopyStill(const ShadowRegion::Rectangle& part);
  // Of robots only the sides in the sun are drawn, with fewer triangles: enough for what has an
  // inside.
  void DrawCasters(const RenderList& render_list, const std::vector<std::size_t>& casters,
                   std::vector<float>& map);
  void DrawCaster(const raster::Drawn& caster, const float (&depth_row)[4], bool both_sides,
                  std::vector<float>& map);
  F8 Lit(F8 x, F8 y, F8 z) const;

  std::vector<float> still_,
      moving_;  // kStride a row, with an edge of one texel that hides nothing
  ShadowRegion region_;
  Drawn drawn_;                                 // what still_ holds
  std::vector<ShadowRegion::Rectangle> moved_;  // where moving_ differs from still_
  Rasteriser rasteriser_;
};

}  // namespace gsv::rendering::raster
