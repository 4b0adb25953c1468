#include "gsv/rendering/lenses/camera_view.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace gsv::rendering {
namespace {

using geometry::Vector3;

TEST(CheckCamera, NamesTheParameterThatIsOutOfRange) {
  EXPECT_TRUE(Check(CameraParameters{}));
  const auto sentence = [](CameraParameters camera) {
    const base::Status status = Check(camera);
    return status ? std::string() : status.error().message;
  };
  EXPECT_NE(sentence({.width = 0}).find("0 by 240 pixels"), std::string::npos);
  EXPECT_NE(sentence({.height = 5000}).find("4096"), std::string::npos);
  EXPECT_NE(sentence({.horizontal_fov = 3.14}).find("horizontal_fov"), std::string::npos);
  EXPECT_NE(sentence({.horizontal_fov = std::nan("")}).find("horizontal_fov"), std::string::npos);
  EXPECT_NE(sentence({.near = 0}).find("clip.near"), std::string::npos);
  EXPECT_NE(sentence({.near = 2, .far = 1}).find("clip.far"), std::string::npos);
}

TEST(FocalLength, OfA90DegreeViewIsHalfTheWidth) {
  EXPECT_NEAR(FocalLength({.width = 320, .horizontal_fov = std::numbers::pi / 2}), 160, 1e-9);
}

// Returns the coordinates u and v of a point, and its depth. They are computed from the matrix as
// on the graphics card.
Vector3 Project(const CameraView& view, const Vector3& point_in_world) {
  const auto m = ClipFromRelative(view);
  const Vector3 p = point_in_world - view.world_from_camera.position;
  double clip[4];
  for (int row = 0; row < 4; ++row) {
    clip[row] = m[row] * p.x + m[4 + row] * p.y + m[8 + row] * p.z + m[12 + row];
  }
  return {(clip[0] / clip[3] + 1) / 2 * view.parameters.width,
          (clip[1] / clip[3] + 1) / 2 * view.parameters.height, clip[2] / clip[3]};
}

TEST(ClipFromRelative, ProjectsLikeAPinholeCamera) {
  const CameraView view{{{1, 2, 3}, geometry::FromRollPitchYaw({0.1, -0.3, 2})},
                        {640, 480, 1.2, 0.1, 50}};
  const double f = 320 / std::tan(0.6);
  for (const Vector3& p : {Vector3{2, 0, 0}, Vector3{5, 1, -1}, Vector3{20, -7, 3}}) {
    const Vector3 seen = Project(view, view.world_from_camera * p);
    EXPECT_NEAR(seen.x, 320 - f * p.y / p.x, 1e-3);
    EXPECT_NEAR(seen.y, 240 - f * p.z / p.x, 1e-3);
  }
}

TEST(ClipFromRelative, DepthIsOneAtTheNearPlaneAndZeroAtTheFarPlane) {
  const CameraView view{{}, {320, 240, 1, 0.1, 100}};
  EXPECT_NEAR(Project(view, {0.1, 0, 0}).z, 1, 1e-6);
  EXPECT_NEAR(Project(view, {100, 0, 0}).z, 0, 1e-6);
}

TEST(Frustum, ContainsWhatTheCameraSees) {
  // The view is 90° wide and high, so the sides of the frustum are the planes |y| = x and |z| = x.
  const CameraView view{{{0, 0, 10}, geometry::FromAxisAngle({0, 0, 1}, std::numbers::pi / 2)},
                        {100, 100, std::numbers::pi / 2, 1, 20}};
  const Frustum frustum = FrustumOf(view);
  // ahead of the camera, which is the world's y axis
  EXPECT_TRUE(frustum.MeetsSphere({0, 5, 0}, 0));
  EXPECT_FALSE(frustum.MeetsSphere({0, -5, 0}, 1));  // behind the camera
  EXPECT_TRUE(frustum.MeetsSphere({4.9, 5, 0}, 0));
  EXPECT_FALSE(frustum.MeetsSphere({5.2, 5, 0}, 0.1));  // 0.2 / sqrt(2) outside the side plane
  EXPECT_TRUE(frustum.MeetsSphere({5.2, 5, 0}, 0.15));
  EXPECT_FALSE(frustum.MeetsSphere({0, 0.5, 0}, 0.4));
  EXPECT_FALSE(frustum.MeetsSphere({0, 21, 0}, 0.9));
}

}  // namespace
}  // namespace gsv::rendering
