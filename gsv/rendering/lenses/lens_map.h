// Resamples pinhole images into an image through a lens. One pinhole image is sufficient if it
// covers the view of the lens. Otherwise, several images are needed: the faces of a cube around the
// camera.
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

// Computes an image through a lens from pinhole images.
class LensMap {
 public:
  // Only `near` and `far` of `camera` are used. The pinhole images have the largest resolution
  // (pixels per radian) of the lens, but at most four times its resolution at the centre. They have
  // at most kMaxImageSide pixels per side.
  LensMap(const Lens& lens, const CameraParameters& camera);

  // The maximum number of pixels of an image. A map takes 20 bytes per pixel.
  static constexpr int kMaxPixels = 4'194'304;

  // The direction of a pixel's centre as a unit vector in the camera's frame. It equals
  // Lens::RayAt() within 1e-6 rad. Pixels are numbered in rows from the top.
  std::optional<geometry::Vector3> RayOfPixel(std::size_t pixel) const;

  // Returns the views of the required pinhole images.
  std::vector<CameraView> Views(const geometry::Pose& world_from_camera) const;

  // Resamples the images of Views(), in that order. Pixels are black where the lens shows nothing.
  model::Image Join(std::span<const std::shared_ptr<const model::Image>> images) const;
  // Resamples depth and label images by the nearest pixel. Pixels are background where the lens
  // shows nothing. Depth is along the camera's view, and negative behind the camera.
  GroundTruth Join(std::span<const std::shared_ptr<const GroundTruth>> truths) const;

 private:
  // One pinhole image: the direction of its view, and its camera.
  struct Face {
    geometry::Quaternion camera_from_face;
    CameraParameters camera;
  };
  // The position in a face's image from which a pixel is sampled.
  struct Source {
    std::int32_t face = -1;  // index of the face; -1 if the lens shows nothing there
    float u = 0, v = 0;      // pixel coordinates in the face's image
    float reach = 1;  // side of the square of face pixels that this pixel covers, in face pixels
    float depth_scale = 0;  // factor that converts depth in the face to depth in the camera
  };
  // Sets the member `reach` of all sources.
  void FindReach();

  int width_, height_;
  std::vector<Face> faces_;
  std::vector<Source> sources_;  // in rows from the top
};

}  // namespace gsv::rendering
