#include "gsv/rendering/lenses/camera_view.h"

#include <cmath>
#include <string>

namespace gsv::rendering {
namespace {

using base::ErrorCode;
using base::Fail;
using geometry::Vector3;

std::string Number(double value) {
  std::string text = std::to_string(value);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text;
}

}  // namespace

base::Status Check(const CameraParameters& camera) {
  const auto refuse = [](const std::string& sentence) {
    return Fail(ErrorCode::kInvalidArgument, sentence);
  };
  for (const int side : {camera.width, camera.height}) {
    if (side < 1 || side > kMaxImageSide) {
      return refuse("an image of " + std::to_string(camera.width) + " by " +
                    std::to_string(camera.height) + " pixels: each side must be from 1 to " +
                    std::to_string(kMaxImageSide));
    }
  }
  if (!(camera.horizontal_fov >= 0.01 && camera.horizontal_fov <= 3.0)) {
    return refuse("a horizontal_fov of " + Number(camera.horizontal_fov) +
                  " rad: a pinhole camera has from 0.01 to 3.0");
  }
  if (!(camera.near >= 1e-4 && camera.near < camera.far && camera.far <= 1e6)) {
    return refuse("clip.near " + Number(camera.near) + " and clip.far " + Number(camera.far) +
                  ": near must be at least 0.0001 m, below far, and far at most 1000000 m");
  }
  return {};
}

double FocalLength(const CameraParameters& camera) {
  return 0.5 * camera.width / std::tan(0.5 * camera.horizontal_fov);
}

Frustum FrustumOf(const CameraView& view) {
  const geometry::Quaternion& q = view.world_from_camera.orientation;
  const CameraParameters& camera = view.parameters;
  // half the width of the view at x = 1
  const double right = 0.5 * camera.width / FocalLength(camera);
  const double top = 0.5 * camera.height / FocalLength(camera);
  const auto side = [&](const Vector3& normal) {
    return Frustum::Plane{q * geometry::Normalized(normal), 0};
  };
  const Vector3 forward = q * Vector3{1, 0, 0};
  return {{side({right, 1, 0}), side({right, -1, 0}), side({top, 0, 1}), side({top, 0, -1}),
           Frustum::Plane{forward, -camera.near}, Frustum::Plane{-forward, camera.far}}};
}

std::array<float, 16> ClipFromRelative(const CameraView& view) {
  const geometry::Quaternion& q = view.world_from_camera.orientation;
  const CameraParameters& camera = view.parameters;
  const Vector3 forward = q * Vector3{1, 0, 0}, left = q * Vector3{0, 1, 0},
                up = q * Vector3{0, 0, 1};
  const double f = FocalLength(camera);
  const double sx = 2 * f / camera.width, sy = 2 * f / camera.height;
  // With x as the distance along the view: w = x and depth = near (far - x) / ((far - near) x).
  const double depth_x = -camera.near / (camera.far - camera.near);
  const double depth_1 = camera.near * camera.far / (camera.far - camera.near);
  // Row 0 points to the right. Row 1 points down, so that the first row of the image in memory is
  // the top row.
  const Vector3 rows[4] = {-sx * left, -sy * up, depth_x * forward, forward};
  const double constants[4] = {0, 0, depth_1, 0};
  std::array<float, 16> m;
  for (int row = 0; row < 4; ++row) {
    m[row] = static_cast<float>(rows[row].x);
    m[4 + row] = static_cast<float>(rows[row].y);
    m[8 + row] = static_cast<float>(rows[row].z);
    m[12 + row] = static_cast<float>(constants[row]);
  }
  return m;
}

}  // namespace gsv::rendering
