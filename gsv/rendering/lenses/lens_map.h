// How a picture through a lens is put together from pinhole pictures: one where a single one covers
// all that the lens shows, else the faces of a cube about the camera that it looks at.
//
// Threads  const members may run concurrently.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "gsv/model/image.h"
#include "gsv/rendering/lenses/camera_view.h"
#include "gsv/rendering/lenses/ground_truth.h"
#include "gsv/rendering/lenses/lens.h"

namespace gsv::rendering {

class LensMap {
 public:
  // `camera` gives near and far. The pinhole pictures have as many pixels an angle as the lens has
  // where it has most, but at most four times as many as in its middle, and kMaxImageSide a side.
  LensMap(const Lens& lens, const CameraParameters& camera);

  // So large a picture may be: a map takes 20 bytes a pixel.
  static constexpr int kMaxPixels = 4'194'304;

  // Where the middle of a pixel looks, in the camera's frame and of unit length, as Lens::RayAt()
  // but for rounding (1e-6 rad); pixels count in rows from the top.
  std::optional<geometry::Vector3> RayOfPixel(std::size_t pixel) const;

  // The pinhole pictures that are needed.
  std::vector<CameraView> Views(const geometry::Pose& world_from_camera) const;

  // Of the pictures of Views(), in that order. Black where the lens shows nothing.
  model::Image Join(std::span<const std::shared_ptr<const model::Image>> pictures) const;
  // The same, of the nearest pixels; nothing where the lens shows nothing. Depth is along the
  // camera's view, which is negative for what a fisheye sees behind it.
  GroundTruth Join(std::span<const std::shared_ptr<const GroundTruth>> truths) const;

 private:
  struct Face {
    geometry::Quaternion camera_from_face;
    CameraParameters camera;
  };
  // Where a pixel comes from.
  struct Source {
    std::int32_t face = -1;  // -1: the lens shows nothing there
    float u = 0, v = 0;      // in the face's picture
    float reach = 1;         // of the face's pixels that this one covers, along a side
    float depth_scale = 0;   // the camera's depth for one of the face
  };
  void FindReach();

  int width_, height_;
  std::vector<Face> faces_;
  std::vector<Source> sources_;  // rows from the top
};

}  // namespace gsv::rendering
