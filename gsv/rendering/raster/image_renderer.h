// Renders the view of one camera.
//
// It first finds the visible triangle of each pixel: opaque items from near to far, with the ground
// last. Then each pixel is shaded once, in tiles. Then transparent items are blended from far to
// near.
//
// If successive images have the same view, tiles keep their colours for the next image, from the
// second image on. A tile is kept if it shows only still bodies and no moving body casts a shadow
// on it. This does not change the image: a new ImageRenderer would render the same one. The first
// image keeps no tiles, because most cameras move with a robot and have another view each time.
// Threads  one thread at a time; it shades on the threads of a team.
#pragma once

#include <vector>

#include "gsv/base/thread_team.h"
#include "gsv/model/image.h"
#include "gsv/rendering/lenses/depth_grid.h"
#include "gsv/rendering/lenses/ground_truth.h"
#include "gsv/rendering/raster/pixel_loops.h"
#include "gsv/rendering/raster/sun_shadow.h"

namespace gsv::rendering::raster {

// Renders the view of one camera on the processor.
class ImageRenderer {
 public:
  using MakeLoops = std::unique_ptr<PixelLoops> (*)();
  explicit ImageRenderer(MakeLoops make_loops) : make_loops_(make_loops) {}

  // Renders a posed render list, antialiased. `render_list_id` identifies the render list. `block`
  // must include the shadow parameters. If `shadow` is null, there are no shadows. If `team` is
  // null, everything is done on the caller's thread.
  model::Image Draw(const CameraView& view, const RenderList& render_list,
                    std::uint64_t render_list_id, const FrameBlock& block, const SunShadow* shadow,
                    base::ThreadTeam* team = nullptr);
  // Returns the depths of the last image. Transparent surfaces are left out.
  DepthGrid SampleDepth(int spacing) const;
  // Renders the depth and label image of a view.
  GroundTruth DrawGroundTruth(const CameraView& view, const RenderList& render_list,
                              const FrameBlock& block);
  // The number of allocated pixels (a measure of memory).
  std::size_t pixels() const { return nearest_.size(); }
  // Whether the last image had this view.
  bool IsOf(const CameraView& view) const;

 private:
  struct Seen {
    // distance of the nearest point (opaque items) or of the centre (transparent items)
    double distance = 0;
    std::size_t item = 0;  // index of the item in the render list
    const Level* level = nullptr;
  };

  // The properties on which the colours of still bodies depend.
  struct Background {
    CameraView view;
    std::uint64_t render_list_id = 0;  // 0: none
    int moved_count = 0;
    bool has_shadow = false;
    FrameBlock block{};
  };
  struct Tile {
    // Whether the tile's colours in rgba_ can be used again: they show no moving body or its
    // shadow.
    bool is_kept = false;
    // The texels of the shadow map that the shading of the tile may read.
    ShadowRegion::Rectangle in_shadow{0, 0, 0, 0};
  };

  // Clears the image.
  void Begin(const CameraView& view, const FrameBlock& block);
  // Lists the items that the camera may see, in the order in which they are drawn.
  void FindVisible(const CameraView& view, const RenderList& render_list);
  // Finds the nearest opaque triangle of each pixel.
  void Cover(const CameraView& view, const RenderList& render_list);
  // Whether the items that are already drawn hide a sphere.
  bool IsHidden(const CameraView& view, const geometry::Vector3& centre, double radius) const;
  // Updates the nearest triangle of each pixel by the triangles of the item drawn_[number].
  void CoverWith(std::uint32_t number);
  // Discards the kept tiles if `background` differs from that of the last image.
  void SetBackground(const Background& background);
  // Shades all opaque pixels, tile by tile.
  void Light(const SunShadow* shadow, base::ThreadTeam* team);
  // Shades the opaque pixels of the tile at (x0, y0).
  void LightTile(PixelLoops& loops, const SunShadow* shadow, int x0, int y0);
  // Whether all pixels of the tile show bodies that have not moved.
  bool IsStillTile(int x0, int y0, int x1, int y1) const;
  // Returns the texels of the shadow map that the shading of points in the box may read.
  ShadowRegion::Rectangle InShadow(const TileToShade& box) const;
  // Blends the transparent items.
  void Blend(const CameraView& view, const RenderList& render_list, const SunShadow* shadow);
  // Returns the antialiased image.
  model::Image Smooth() const;

  // The index of pixel (x, y).
  std::size_t At(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(stride_) +
           static_cast<std::size_t>(x);
  }

  int width_ = 0, height_ = 0, stride_ = 0;
  // The ray through the centre of pixel (x, y) has the direction forward_ + x right_ + y down_.
  Float4 forward_, right_, down_;
  std::vector<float> inverse_w_;        // 1/w of the nearest surface, by pixel
  std::vector<std::uint32_t> nearest_;  // number of the nearest triangle, by pixel, from 1; 0 is
                                        // the sky
  std::vector<Triangle> triangles_;
  const MakeLoops make_loops_;
  ImageInProgress in_progress_;
  std::vector<std::unique_ptr<PixelLoops>> loops_;  // one for each thread
  std::vector<std::uint8_t> is_blended_;  // for each tile, whether a transparent item was blended
  std::vector<Drawn> drawn_;  // the items of the image; Triangle::drawn is an index in this list
  std::vector<std::uint8_t> is_still_;  // whether each opaque item of drawn_ is still
  std::vector<std::int32_t> body_of_,
      visual_of_;  // one for each opaque item, in the order of drawn_
  std::vector<Seen> solid_, transparent_;
  std::vector<std::uint32_t> rgba_;
  Background background_;
  bool is_repeated_ = false;  // whether the image before had the same background_
  std::vector<Tile> tiles_;   // row by row
  Rasteriser rasteriser_;
};

}  // namespace gsv::rendering::raster
