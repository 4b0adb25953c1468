// Lenses: pinholes with distortion, and wide lenses (fisheye).
//
// Frames  camera frame as in camera_view.h: x along the view, y left, z up. Image points (u, v) in
//         pixels from the upper left corner, to the right and down.
// Units   pixels, radians.
//
// Pinhole    with x = -Y/X to the right and y = -Z/X down for a point (X, Y, Z):
//              u = fx x' + skew y' + cx,  v = fy y' + cy
//            where (x', y') is (x, y) distorted after Brown and Conrady, about the centre c, with
//            p = (x, y) - c and r² = |p|²:
//              x' = c.x + p.x (1 + k1 r² + k2 r⁴ + k3 r⁶) + 2 p1 p.x p.y + p2 (r² + 2 p.x²)
//              y' = c.y + p.y (1 + k1 r² + k2 r⁴ + k3 r⁶) + p1 (r² + 2 p.y²) + 2 p2 p.x p.y
//            This is "plumb_bob" of ROS and OpenCV if c is the principal point. With a strong
//            barrel distortion, rays beyond a certain angle would be imaged inside the image again.
//            They are left out.
// Wide view  a point at the angle a from the view axis is imaged at the distance
//              r = c1 f fun(a / c2 + c3)
//            from the image's centre, in units of half the image's width (SDFormat's <lens>). The
//            lens shows nothing beyond the cutoff angle.
#pragma once

#include <optional>
#include <string>

#include "gsv/base/error.h"
#include "gsv/rendering/lenses/camera_view.h"

namespace gsv::rendering {

// The coefficients of Brown and Conrady's distortion of a pinhole camera.
struct Distortion {
  double k1 = 0, k2 = 0, k3 = 0, p1 = 0, p2 = 0;
  geometry::Vector2 centre{0.5, 0.5};  // as fractions of the image's width and height

  // Whether there is no distortion.
  bool is_none() const { return k1 == 0 && k2 == 0 && k3 == 0 && p1 == 0 && p2 == 0; }
  friend bool operator==(const Distortion&, const Distortion&) = default;
};

// Focal lengths, principal point and skew, in pixels.
struct Intrinsics {
  double fx = 0, fy = 0;
  double cx = 0, cy = 0;
  double skew = 0;
  friend bool operator==(const Intrinsics&, const Intrinsics&) = default;
};

// The projection of a wide lens: r = c1 f function(a / c2 + c3).
struct WideView {
  enum class Function { kIdentity, kSine, kTangent };
  Function function = Function::kTangent;
  double c1 = 1, c2 = 1, c3 = 0, f = 1;
  // angle from the view axis beyond which the image is black
  double cutoff_angle = 1.5707963267948966;
  friend bool operator==(const WideView&, const WideView&) = default;
};

// Returns the view named "gnomonical", "stereographic", "equidistant", "equisolid_angle" or
// "orthographic".
base::Result<WideView> WideViewNamed(const std::string& type);

// A camera lens: converts between image points and directions.
class Lens {
 public:
  // A pinhole without distortion.
  explicit Lens(const CameraParameters& camera);
  // A pinhole with these intrinsics and this distortion.
  Lens(const CameraParameters& camera, const Intrinsics& intrinsics, const Distortion& distortion);
  // Creates a wide lens; only the image size of `camera` is used. If `horizontal_fov` is greater
  // than 0, view.f is ignored, and f is computed so that the image's width spans this angle (at
  // most 2 pi). Fails with kInvalidArgument if the lens cannot span the angle.
  static base::Result<Lens> Wide(const CameraParameters& camera, WideView view,
                                 double horizontal_fov);

  // Whether this is a pinhole without distortion whose intrinsics follow from horizontal_fov.
  // Images of such a lens need no resampling.
  bool is_plain() const { return is_plain_; }

  // Returns the direction of an image point, as a unit vector in the camera's frame; nullopt if the
  // lens shows nothing there.
  std::optional<geometry::Vector3> RayAt(double u, double v) const;
  // Projects a point in the camera's frame. The result may be beyond the image's edges. Returns
  // nullopt if the point has no image.
  std::optional<geometry::Vector2> Project(const geometry::Vector3& point) const;

  int width() const { return width_; }
  int height() const { return height_; }
  const Intrinsics& intrinsics() const { return intrinsics_; }  // only for a pinhole
  const Distortion& distortion() const { return distortion_; }
  const std::optional<WideView>& wide_view() const { return wide_; }  // nullopt for a pinhole
  // Whether RayAt() is computed in closed form, without a search.
  bool has_quick_rays() const { return wide_ || distortion_.is_none(); }
  friend bool operator==(const Lens&, const Lens&) = default;

 private:
  // Distorted() applies the distortion, and Undistorted() inverts it. Both are for points in the
  // normalized image plane (focal length 1).
  geometry::Vector2 Distorted(const geometry::Vector2& p) const;
  // Returns the point that Distorted() maps to `p`; nullopt if there is none.
  std::optional<geometry::Vector2> Undistorted(const geometry::Vector2& p) const;

  int width_ = 0, height_ = 0;  // size of the image, pixels
  bool is_plain_ = true;
  Intrinsics intrinsics_;
  Distortion distortion_;
  geometry::Vector2 centre_;      // the centre of distortion in the normalized image plane
  std::optional<WideView> wide_;  // nullopt for a pinhole
};

}  // namespace gsv::rendering
