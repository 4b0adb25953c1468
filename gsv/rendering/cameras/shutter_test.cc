// Tests motion blur and rolling shutter with objects that move at known speeds.
#include "gsv/rendering/cameras/shutter.h"

#include <cmath>

#include <gtest/gtest.h>

#include "gsv/base/test_within.h"
#include "gsv/rendering/cameras/camera_sensor.h"
#include "gsv/rendering/lenses/light_encoding.h"
#include "gsv/rendering/testing/test_scene.h"

namespace gsv::rendering {
namespace {

using geometry::Vector3;

constexpr int kWidth = 320, kHeight = 240;
constexpr double kFov = 1.047;
constexpr double kDistance = 4;  // distance from the camera, m
// The focal length, in pixels.
double Focal() { return 0.5 * kWidth / std::tan(0.5 * kFov); }

class ShutterTest : public testing::Test {
 protected:
  ShutterTest() {
    EXPECT_TRUE(AddCameraSensor(registry_, renderer_));
    scene_.description().scene.background = {0, 0, 0, 1};
    scene_.Add("robot", geometry::Box{{0.1, 0.1, 0.1}}, {{0, 0, -3}, {}}, Matt(0, 0, 0));
  }
  void SetUp() override {
    if (!renderer_) GTEST_SKIP() << renderer_.error().Sentence();
  }

  void AddThing(geometry::Shape shape, const Vector3& velocity) {
    scene_.Add("thing", std::move(shape), {{kDistance, 0, 0}, {}}, Glowing(1, 0, 0));
    velocity_ = velocity;
  }
  model::Image Taken(model::Parameters parameters) {
    model::SensorDescription camera;
    camera.name = "eye";
    camera.type = "camera";
    camera.link_from_sensor.position.z = 3;  // the robot is at the world's origin
    camera.parameters = std::move(parameters);
    camera.parameters["horizontal_fov"] = kFov;
    const auto sensor = registry_.Find("camera")->create(camera);
    EXPECT_TRUE(sensor) << sensor.error().Sentence();
    auto snapshot = std::make_shared<world::Snapshot>(*scene_.Snapshot());
    const auto body = [&](const char* name) -> world::BodyState& {
      return snapshot->state.bodies[static_cast<std::size_t>(snapshot->layout->Find(name))];
    };
    body("thing").linear_velocity = velocity_;
    body("robot").angular_velocity = {0, 0, turning_};
    const auto reading =
        (*sensor)->Sample(sensing::Sampling(snapshot, snapshot->layout->Find("robot"), 1, rays_));
    EXPECT_TRUE(reading) << reading.error().Sentence();
    return reading ? *reading->image : model::Image();
  }

  base::Result<std::shared_ptr<Renderer>> renderer_ = Renderer::Start();
  sensing::SensorRegistry registry_;
  sensing::RaySceneCache rays_;
  TestScene scene_;
  Vector3 velocity_;
  double turning_ = 0;  // turning rate of the robot, rad/s
};

// The first and the last column of a row that are red.
struct RedColumns {
  int first = -1, last = -1;
  double middle() const { return 0.5 * (first + last + 1); }
  int width() const { return first < 0 ? 0 : last - first + 1; }
};
RedColumns RedIn(const model::Image& image, int row) {
  RedColumns red;
  for (int x = 0; x < image.width; ++x) {
    const std::uint8_t* p = &image.pixels[3 * (static_cast<std::size_t>(row) * image.width + x)];
    if (p[0] < p[1] + 20) continue;
    if (red.first < 0) red.first = x;
    red.last = x;
  }
  return red;
}

TEST_F(ShutterTest, DefaultsLeaveImagesUnchanged) {
  AddThing(geometry::Sphere{0.2}, {0, 3, 0});
  EXPECT_EQ(Taken({}).pixels, Taken({{"exposure_time", 0.0}, {"shutter_samples", 4.0}}).pixels);
}

TEST_F(ShutterTest, MovingObjectIsBlurredAlongItsPath) {
  AddThing(geometry::Box{{0.01, 0.2, 0.2}}, {0, 2, 0});  // the object moves to the left
  const RedColumns still = RedIn(Taken({}), kHeight / 2);
  const RedColumns moved =
      RedIn(Taken({{"exposure_time", 0.1}, {"shutter_samples", 32.0}}), kHeight / 2);
  // In 0.1 s, the object moves by 0.2 m from the right to its position in the snapshot. The 32
  // samples are at the centres of 32 parts of this time.
  const double way = Focal() * 2 * 0.1 / kDistance;
  EXPECT_WITHIN(moved.width() - still.width(), way * 31 / 32, 1.5, "pixel");
  EXPECT_WITHIN(moved.last - still.last, way * 63 / 64, 1.5, "pixel");
  EXPECT_WITHIN(moved.first, still.first, 1.5, "pixel");
}

// During the exposure, light of the object reaches each column of its path for a part of the time.
TEST_F(ShutterTest, BlurDistributesTheLightAlongThePath) {
  AddThing(geometry::Box{{0.01, 0.2, 0.2}}, {0, 2, 0});
  const model::Image blurred = Taken({{"exposure_time", 0.4}, {"shutter_samples", 64.0}});
  const model::Image still = Taken({});
  const auto light_at = [](const model::Image& image, int column) {
    return LightOf(image.pixels[3 * (static_cast<std::size_t>(kHeight / 2) * kWidth + column)]);
  };
  // The object covers 0.2 m of 0.8 m. So a quarter of the light is from the object, and the rest is
  // from the background.
  const int column = kWidth / 2 + static_cast<int>(Focal() * 0.4 / kDistance);
  const float expected = 0.25f * light_at(still, kWidth / 2) + 0.75f * light_at(still, column);
  EXPECT_WITHIN(100 * light_at(blurred, column), 100 * expected, 2, "% of white");
  EXPECT_GT(light_at(still, kWidth / 2), 0.5);
}

TEST_F(ShutterTest, TurningCameraBlursStaticObjects) {
  AddThing(geometry::Box{{0.01, 0.2, 0.2}}, {});
  turning_ = 1;
  const RedColumns turned =
      RedIn(Taken({{"exposure_time", 0.1}, {"shutter_samples", 32.0}}), kHeight / 2);
  turning_ = 0;
  const RedColumns still = RedIn(Taken({}), kHeight / 2);
  // Earlier, the camera was rotated 0.1 rad to the right, so the object was to the left of its
  // current position in the image.
  EXPECT_WITHIN(still.first - turned.first, Focal() * std::tan(0.1 * 63 / 64), 2, "pixel");
  EXPECT_WITHIN(turned.last, still.last, 1.5, "pixel");
}

TEST_F(ShutterTest, RollingShutterSkewsMovingObjects) {
  AddThing(geometry::Box{{0.01, 0.05, 6}}, {0, 4, 0});
  const model::Image image = Taken({{"readout_time", 0.05}, {"shutter_samples", 32.0}});
  for (int row = 5; row < kHeight; row += 23) {
    const double age = 0.05 * (1 - (row + 0.5) / kHeight);
    const double expected = kWidth / 2.0 + Focal() * 4 * age / kDistance;
    EXPECT_WITHIN(RedIn(image, row).middle(), expected, 1, "pixel") << row;
  }
}

TEST(Shutter, EarlierExtrapolatesPosesFromVelocities) {
  TestScene scene;
  scene.Add("it", geometry::Sphere{1}, {{1, 2, 3}, {}}, Matt(1, 1, 1));
  world::Snapshot snapshot = *scene.Snapshot();
  snapshot.state.bodies[0].linear_velocity = {2, 0, -4};
  snapshot.state.bodies[0].angular_velocity = {0, 0, 0.5};
  const auto earlier = Earlier(snapshot, 0.25);
  const geometry::Pose& pose = earlier->state.bodies[0].world_from_model;
  EXPECT_LT(Norm(pose.position - Vector3{0.5, 2, 4}), 1e-12);
  EXPECT_NEAR(geometry::Yaw(pose.orientation), -0.125, 1e-12);
}

TEST_F(ShutterTest, RejectsInvalidTimes) {
  for (const auto& [name, value] :
       {std::pair{"exposure_time", -1.0}, {"readout_time", 11.0}, {"shutter_samples", 1.0}}) {
    model::SensorDescription camera;
    camera.parameters = {{name, value}};
    const auto sensor = registry_.Find("camera")->create(camera);
    ASSERT_FALSE(sensor) << name;
    EXPECT_NE(sensor.error().Sentence().find(name), std::string::npos);
  }
}

}  // namespace
}  // namespace gsv::rendering
