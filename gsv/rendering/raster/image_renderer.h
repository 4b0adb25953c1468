// Renders the view of one camera.
//
// First the visible triangle of each pixel: opaque items from near to far, with the ground last.
// Then each pixel is shaded once. Then transparent items are blended from far to near.
// Threads  one thread at a time.
#pragma once

#include <vector>

#include "gsv/model/image.h"
#include "gsv/rendering/lenses/ground_truth.h"
#include "gsv/rendering/raster/lighting.h"

namespace gsv::rendering::raster {

class ImageRenderer {
 public:
  // Renders a posed render list, antialiased. `block` must be complete. If `shadow` is null, there
  // are no shadows.
  model::Image Draw(const CameraView& view, const RenderList& render_list, const FrameBlock& block,
                    const SunShadow* shadow);
  // Renders the depth and label image of a view.
  GroundTruth DrawGroundTruth(const CameraView& view, const RenderList& render_list,
                              const FrameBlock& block);
  // The number of allocated pixels.
  std::size_t pixels() const { return nearest_.size(); }

 private:
  struct Seen {
    // for opaque items, to the nearest point; for transparent ones, to the centre
    double distance = 0;
    std::size_t item = 0;
    const Level* level = nullptr;
  };

  void Begin(const CameraView& view, const FrameBlock& block);
  void FindVisible(const CameraView& view, const RenderList& render_list);
  void Cover(const CameraView& view, const RenderList& render_list);
  bool IsHidden(const CameraView& view, const geometry::Vector3& centre, double radius) const;
  void CoverWith(std::uint32_t number, float nearest_w);
  void Light(const LightModel& light);
  void LightTile(const LightModel& light, int x0, int y0);
  Lamps LampsOfTile(const LightModel& light, int x0, int y0, int x1, int y1) const;
  void Light(const LightModel& light, const Lamps& lamps, int x, int y);
  void Blend(const CameraView& view, const RenderList& render_list, const LightModel& light);
  model::Image Smooth() const;
  F8x3 RayAt(int x, int y) const;

  std::size_t At(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(stride_) +
           static_cast<std::size_t>(x);
  }

  int width_ = 0, height_ = 0, stride_ = 0;
  // the direction of a pixel's ray, as parts that depend on the pixel's position
  Float4 forward_, right_, down_;
  std::vector<float> inverse_w_;        // by pixel, of the nearest surface
  std::vector<std::uint32_t> nearest_;  // by pixel, the number of the triangle from 1; 0 is the sky
  std::vector<Triangle> triangles_;
  // The index in surfaces_ by triangle number - 1, or -1.
  std::vector<std::int32_t> surface_of_;
  std::vector<TriangleSurface> surfaces_;
  std::vector<Drawn> drawn_;
  std::vector<std::int32_t> body_of_, visual_of_;  // the same order as drawn_, for opaque items
  std::vector<Seen> solid_, transparent_;
  std::vector<std::uint32_t> rgba_;
  Rasteriser rasteriser_;
};

}  // namespace gsv::rendering::raster
