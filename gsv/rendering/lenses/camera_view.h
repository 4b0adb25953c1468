// A pinhole camera: its frustum and projection.
//
// Frames  camera frame C as a sensor frame: x along the view, y left, z up. Pixels: u to the right
//         and v down from the image's upper left corner; pixel (i, j) covers [i, i + 1) by [j, j +
//         1).
// Model   u = width/2 - f y/x, v = height/2 - f z/x with f = width / (2 tan(horizontal_fov / 2)).
#pragma once

#include <array>

#include "gsv/base/error.h"
#include "gsv/geometry/pose.h"

namespace gsv::rendering {

// Units  pixels, radians, metres.
struct CameraParameters {
  int width = 320;
  int height = 240;
  double horizontal_fov = 1.047;
  // Distances along the view. Surfaces nearer than `near` or beyond `far` are not drawn.
  double near = 0.1;
  double far = 100;
  friend bool operator==(const CameraParameters&, const CameraParameters&) = default;
};

inline constexpr int kMaxImageSide = 4096;  // maximum width and height of an image, pixels

// Fails with kInvalidArgument, and names the invalid parameter.
base::Status Check(const CameraParameters& camera);

double FocalLength(const CameraParameters& camera);  // Returns the focal length in pixels.

// A camera with its pose in the world.
struct CameraView {
  geometry::Pose world_from_camera;
  CameraParameters parameters;
};

// The six planes of a camera's frustum, in a frame with the world's axes and its origin at the
// camera. Normals point inward.
struct Frustum {
  // The points p with Dot(normal, p) + offset = 0. `normal` has unit length.
  struct Plane {
    geometry::Vector3 normal;
    double offset = 0;
  };
  std::array<Plane, 6> planes;

  // Whether the sphere may reach into the frustum.
  bool MeetsSphere(const geometry::Vector3& centre, double radius) const {
    for (const Plane& plane : planes) {
      if (geometry::Dot(plane.normal, centre) + plane.offset < -radius) return false;
    }
    return true;
  }
  // Whether a sphere that moves from `centre` by `offset` may reach into the frustum. Conservative:
  // may return true without an intersection.
  bool MeetsMovingSphere(const geometry::Vector3& centre, const geometry::Vector3& offset,
                         double radius) const {
    for (const Plane& plane : planes) {
      const double start = geometry::Dot(plane.normal, centre) + plane.offset;
      if (start < -radius && start + geometry::Dot(plane.normal, offset) < -radius) return false;
    }
    return true;
  }
};

// Returns the frustum of a camera.
Frustum FrustumOf(const CameraView& view);

// Returns the transformation from the frame of FrustumOf() to clip space, as a column-major matrix
// for OpenGL. Depth is from 1 (near) to 0 (far); rows are from top to bottom.
std::array<float, 16> ClipFromRelative(const CameraView& view);

}  // namespace gsv::rendering
