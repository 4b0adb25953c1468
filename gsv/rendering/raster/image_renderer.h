// Draws what one camera sees.
//
// First which triangle is seen at each pixel: solid things, nearest first and the ground last. Then
// each pixel's light, once. Then what is see-through, farthest first.
// Threads  one thread at a time.
#pragma once

#include <vector>

#include "gsv/model/image.h"
#include "gsv/rendering/lenses/ground_truth.h"
#include "gsv/rendering/raster/lighting.h"

namespace gsv::rendering::raster {

class ImageRenderer {
 public:
  // Of a posed plan, with smooth edges. `block` is complete; without `shadow` (null) everything is
  // in the sun.
  model::Image Draw(const CameraView& view, const RenderList& render_list, const FrameBlock& block,
                    const SunShadow* shadow);
  // The same without light.
  GroundTruth DrawGroundTruth(const CameraView& view, const RenderList& render_list,
                              const FrameBlock& block);
  // Of the last picture, as many as there is room for now.
  std::size_t pixels() const { return nearest_.size(); }

 private:
  struct Seen {
    double distance = 0;  // solid: to where it begins; see-through: to its middle
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
  Float4 forward_, right_, down_;       // of a pixel's ray, by the pixel's place
  std::vector<float> inverse_w_;        // of what is nearest at each pixel
  std::vector<std::uint32_t> nearest_;  // its triangle's number from 1; 0: the sky
  std::vector<Triangle> triangles_;
  std::vector<std::int32_t> surface_of_;  // triangle's number - 1 to its place in surfaces_, or -1
  std::vector<TriangleSurface> surfaces_;
  std::vector<Drawn> drawn_;
  std::vector<std::int32_t> body_of_, visual_of_;  // as drawn_, of what is solid
  std::vector<Seen> solid_, transparent_;
  std::vector<std::uint32_t> rgba_;
  Rasteriser rasteriser_;
};

}  // namespace gsv::rendering::raster
