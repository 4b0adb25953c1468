#include "gsv/view/camera.h"

#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

namespace gsv::view {
namespace {

using geometry::Pose;
using geometry::Vector3;

// The robot "pebble" is at (10, 20, 0), faces along y and is slightly tilted. Its camera "eye" is
// at (10, 20, 0.5) in the world.
SceneLookup Pebble() {
  const Pose pebble{{10, 20, 0}, geometry::FromRollPitchYaw({0.1, 0.2, std::numbers::pi / 2})};
  return {[pebble](const std::string& body) {
            return body == "pebble" ? std::optional(pebble) : std::nullopt;
          },
          [](const std::string& robot, const std::string& sensor) -> base::Result<SensorView> {
            if (robot != "pebble" || sensor != "eye") {
              return base::Fail(base::ErrorCode::kNotFound, "there is no camera");
            }
            return SensorView{{{10, 20, 0.5}, {}}, 1.2};
          },
          [] {
            return std::vector<Vector3>{{-1, -1, 0}, {1, 1, 1}};
          }};
}

rendering::CameraView Placed(const Camera& camera) {
  const auto placed = Place(camera, Pebble());
  EXPECT_TRUE(placed) << placed.error().Sentence();
  return placed ? *placed : rendering::CameraView{};
}

std::string SentenceOf(const Camera& camera) {
  const auto placed = Place(camera, Pebble());
  return placed ? "" : placed.error().Sentence();
}

// Returns the direction in which the camera looks, with unit length.
Vector3 AheadOf(const rendering::CameraView& view) {
  return view.world_from_camera.orientation * Vector3{1, 0, 0};
}

TEST(ViewCamera, LooksFromEyeToTarget) {
  Camera camera;
  camera.eye = {1, 2, 3};
  camera.target = {1, 5, -1};
  const auto view = Placed(camera);
  EXPECT_EQ(view.world_from_camera.position, (Vector3{1, 2, 3}));
  const Vector3 ahead = AheadOf(view);
  EXPECT_NEAR(ahead.x, 0, 1e-12);
  EXPECT_NEAR(ahead.y, 0.6, 1e-12);
  EXPECT_NEAR(ahead.z, -0.8, 1e-12);
  // The camera's left axis is horizontal.
  EXPECT_NEAR((view.world_from_camera.orientation * Vector3{0, 1, 0}).z, 0, 1e-12);
}

TEST(ViewCamera, TheFieldOfViewIsVertical) {
  Camera camera;
  camera.eye = {0, 0, 1};
  camera.target = {1, 0, 1};
  camera.width = 300, camera.height = 100;
  camera.field_of_view = 90;
  // The image is three times as wide as high. The tangent of half the vertical angle is tan(45°) =
  // 1. So the tangent of half the horizontal angle is 3.
  EXPECT_NEAR(std::tan(Placed(camera).parameters.horizontal_fov / 2), 3, 1e-12);
}

TEST(ViewCamera, OfANarrowFieldOfViewSeesFar) {
  Camera camera;
  camera.eye = geometry::Vector3{0, 0, 100'000};
  camera.target = geometry::Vector3{0, 1, 0};
  camera.field_of_view = 1;
  EXPECT_GT(Placed(camera).parameters.far, 200'000);
  camera.field_of_view = 50;
  EXPECT_LT(Placed(camera).parameters.far, 10'000);
}

TEST(ViewCamera, FollowsARobotInItsLevelFrame) {
  Camera camera;
  camera.follow = "pebble";
  camera.eye = {-2, 0, 1};  // the camera is 2 m behind the robot and looks along the world's y axis
  camera.target = {3, 0, 1};
  const auto view = Placed(camera);
  EXPECT_NEAR(view.world_from_camera.position.x, 10, 1e-9);
  EXPECT_NEAR(view.world_from_camera.position.y, 18, 0.1);
  EXPECT_NEAR(view.world_from_camera.position.z, 1, 1e-9);
  EXPECT_NEAR(AheadOf(view).y, 1, 0.01);
  EXPECT_NEAR(AheadOf(view).z, 0, 1e-9);
}

TEST(ViewCamera, ShowsTheViewOfARobotsCamera) {
  Camera camera;
  camera.sensor = "pebble/eye";
  const auto view = Placed(camera);
  EXPECT_EQ(view.world_from_camera.position, (Vector3{10, 20, 0.5}));
  EXPECT_DOUBLE_EQ(view.parameters.horizontal_fov, 1.2);
}

TEST(ViewCamera, ShowsEverythingByDefault) {
  const auto view = Placed({});
  // The camera looks roughly at the centre between the scene's corners.
  const Vector3 middle = geometry::Inverse(view.world_from_camera) * Vector3{0, 0, 0.5};
  EXPECT_GT(middle.x, 1);
  EXPECT_LT(std::hypot(middle.y, middle.z), 0.3 * middle.x);
}

TEST(ViewCamera, RejectsInvalidPoses) {
  Camera robot;
  robot.follow = "nobody";
  EXPECT_EQ(SentenceOf(robot), "there is no robot 'nobody'");
  Camera half;
  half.eye = {1, 2, 3};
  EXPECT_EQ(SentenceOf(half), "the pose of the camera needs both eye and target, in metres");
  half.target = half.eye;
  EXPECT_EQ(SentenceOf(half), "eye and target must be different points");
  Camera sensor;
  sensor.sensor = "pebble";
  EXPECT_NE(SentenceOf(sensor).find("must be ROBOT/CAMERA"), std::string::npos);
  sensor.sensor = "pebble/eye";
  sensor.follow = "pebble";
  EXPECT_NE(SentenceOf(sensor).find("leave out eye"), std::string::npos);
}

TEST(ViewCamera, ReadsSizes) {
  Camera camera;
  ASSERT_TRUE(SetSize("64x48", camera));
  EXPECT_EQ(camera.width, 64);
  EXPECT_EQ(camera.height, 48);
  for (const char* text : {"0x48", "64x0", "100000x48", "64x100000", "-1x48"}) {
    const auto set = SetSize(text, camera);
    ASSERT_FALSE(set) << text;
    EXPECT_NE(set.error().message.find("16 to 4096 pixels"), std::string::npos) << text;
  }
  for (const char* text : {"", "64", "64x", "x48", "64*48", "64x48x2", "9999999999x1"}) {
    const auto set = SetSize(text, camera);
    ASSERT_FALSE(set) << text;
    EXPECT_NE(set.error().message.find("WIDTHxHEIGHT"), std::string::npos) << text;
  }
  EXPECT_EQ(camera.width, 64);
}

TEST(ViewCamera, ReadsPointsAndAngles) {
  EXPECT_EQ(ParsePoint("1,-2.5,3e1", "eye").value(), (Vector3{1, -2.5, 30}));
  for (const char* text : {"", "1", "1,2", "1,2,", "1,2,3,4", "1,2,nan", "1,2,1e300", "a,b,c"}) {
    EXPECT_FALSE(ParsePoint(text, "eye")) << text;
  }
  EXPECT_DOUBLE_EQ(ParseFieldOfView("60").value(), 60);
  for (const char* text : {"", "0", "151", "inf", "60deg"}) {
    EXPECT_FALSE(ParseFieldOfView(text)) << text;
  }
}

}  // namespace
}  // namespace gsv::view
