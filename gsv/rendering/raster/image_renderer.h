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
  // Renders a posed render list, antialiased. `block` must be complete. `shadow` null: no shadows.
  model::Image Draw(const CameraView& view, const RenderList& render_list, const FrameBlock& block,
                    const SunShadow* shadow);
  // The depth and label image of the same view.
  GroundTruth DrawGroundTruth(const CameraView& view, const RenderList& render_list,
                              const FrameBlock& block);
  // The number of allocated pixels.
  std::size_t pixels() const { return nearest_.size(); }

 private:
  struct Seen {
    double distance = 0;  // opaque: to its nearest point; transparent: to its centre
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
  Float4 forward_, right_, down_;       // of a pixel's ray, by the position of the pixel
  std::vector<float> inverse_w_;        // of the nearest surface at each pixel
  std::vector<std::uint32_t> nearest_;  // number of its triangle from 1; 0: the sky
  std::vector<Triangle> triangles_;
  // From triangle number - 1 to the index in surfaces_, or -1.
  std::vector<std::int32_t> surface_of_;
  std::vector<TriangleSurface> surfaces_;
  std::vector<Drawn> drawn_;
  std::vector<std::int32_t> body_of_, visual_of_;  // as drawn_, for opaque items
  std::vector<Seen> solid_, transparent_;
  std::vector<std::uint32_t> rgba_;
  Rasteriser rasteriser_;
};

}  // namespace gsv::rendering::raster
