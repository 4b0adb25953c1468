#include "gsv/rendering/cameras/ground_truth_sensors.h"

#include <cmath>
#include <cstring>
#include <map>

#include <gtest/gtest.h>
#include <png.h>

#include "gsv/base/test_within.h"
#include "gsv/messages/cdr.h"
#include "gsv/messages/sensor_msgs.h"
#include "gsv/messages/vision_msgs.h"
#include "gsv/readings/catalogue.h"
#include "gsv/rendering/testing/test_scene.h"
#include "gsv/sensing/rays/ray_scene.h"

namespace gsv::rendering {
namespace {

using geometry::PlanarPose;
using geometry::Vector3;
using sensing::Reading;

constexpr int kSurveyWidth = 64, kSurveyHeight = 48;
constexpr double kSurveyFov = 1.2;
const double kFocal = kSurveyWidth / (2 * std::tan(kSurveyFov / 2));

// Returns the ray through the middle of a pixel, scaled to a depth of 1.
Vector3 RayOf(int x, int y) {
  return {1, (kSurveyWidth / 2.0 - x - 0.5) / kFocal, (kSurveyHeight / 2.0 - y - 0.5) / kFocal};
}

class GroundTruthTest : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!renderer_) GTEST_SKIP() << renderer_.error().Sentence();
  }

  void Add(const std::string& name, geometry::Shape shape, const geometry::Pose& pose) {
    scene_.Add(name, shape, pose, Matt(1, 1, 1), true);
    model::Collision collision;
    collision.shape = std::move(shape);
    scene_.LinkOf(name).collisions.push_back(collision);
  }

  static model::SensorDescription Description(const std::string& type) {
    model::SensorDescription description;
    description.name = "eye";
    description.type = type;
    // the camera is at (0.3, 0, 1) in the world
    description.link_from_sensor.position = {0.3, 0, 0};
    description.parameters = {{"image.width", double(kSurveyWidth)},
                              {"image.height", double(kSurveyHeight)},
                              {"horizontal_fov", kSurveyFov},
                              {"clip.far", 50.0}};
    return description;
  }

  Reading Sample(const model::SensorDescription& description) {
    snapshot_ = scene_.Snapshot();
    const auto sensor = registry_.Find(description.type)->create(description);
    EXPECT_TRUE(sensor) << sensor.error().Sentence();
    const auto reading =
        (*sensor)->Sample(sensing::Sampling(snapshot_, snapshot_->layout->Find("robot"), 1, rays_));
    EXPECT_TRUE(reading) << reading.error().Sentence();
    return *reading;
  }
  template <typename Message>
  Message Sent(const model::SensorDescription& description, const Reading& reading) {
    const auto sensor = registry_.Find(description.type)->create(description);
    const auto bytes = (*sensor)->Encode(reading, "robot/eye");
    EXPECT_TRUE(bytes);
    const auto message = messages::Decode<Message>(std::as_bytes(std::span(*bytes)));
    EXPECT_TRUE(message);
    return *message;
  }

  explicit GroundTruthTest(BackEnd back_end = BackEnd::kRasteriser)
      : renderer_(Renderer::Start({.back_end = back_end})) {
    if (renderer_) {
      EXPECT_TRUE(AddGroundTruthSensors(registry_, renderer_));
    }
    // The bodies have collisions, so that rays can be cast at them.
    Add("robot", geometry::Box{{0.4, 0.4, 0.4}}, PlanarPose(0, 0, 1, 0));
  }

  base::Result<std::shared_ptr<Renderer>> renderer_;
  TestScene scene_;
  std::shared_ptr<const world::Snapshot> snapshot_;
  sensing::SensorRegistry registry_;
  sensing::RaySceneCache rays_;
};

TEST_F(GroundTruthTest, DepthOfAPlaneEqualsItsEquation) {
  // A wall whose face passes through (4, 0, 1) with a yaw of 0.5 rad.
  const double turn = 0.5;
  const Vector3 normal{-std::cos(turn), -std::sin(turn), 0};
  const Vector3 on_face{4, 0, 1};
  Add("wall", geometry::Box{{0.2, 60, 60}},
      {on_face - 0.1 * normal, geometry::FromRollPitchYaw({0, 0, turn})});
  const Reading reading = Sample(Description("depth_camera"));
  ASSERT_EQ(reading.values.size(), 2u + kSurveyWidth * kSurveyHeight);
  EXPECT_EQ(reading.values[0], kSurveyWidth);
  EXPECT_EQ(reading.values[1], kSurveyHeight);
  for (int y = 0; y < kSurveyHeight; ++y) {
    for (int x = 0; x < kSurveyWidth; ++x) {
      const double expected = Dot(on_face - Vector3{0.3, 0, 1}, normal) / Dot(RayOf(x, y), normal);
      EXPECT_WITHIN_PERCENT(reading.values[2 + y * kSurveyWidth + x], expected, 0.001)
          << x << " " << y;
    }
  }
}

TEST_F(GroundTruthTest, DepthOfTheGroundEqualsItsEquation) {
  Add("floor", geometry::Plane{{0, 0, 1}, {200, 200}}, {});
  const Reading reading = Sample(Description("depth_camera"));
  for (int y = 0; y < kSurveyHeight; ++y) {
    const double down = -RayOf(0, y).z;
    const double depth = reading.values[2 + y * kSurveyWidth + 7];
    if (down <= 0.021) continue;  // the ground is more than 50 m away
    EXPECT_WITHIN_PERCENT(depth, 1 / down, 0.01) << y;
  }
  // this pixel shows the sky
  EXPECT_EQ(reading.values[2 + 7], std::numeric_limits<double>::infinity());
}

TEST_F(GroundTruthTest, DepthImageBecomesAPointCloudMessage) {
  Add("wall", geometry::Box{{0.2, 60, 60}}, PlanarPose(4.4, 0, 1, 0));
  const auto description = Description("rgbd_camera");
  const Reading reading = Sample(description);
  const auto cloud = Sent<messages::sensor_msgs::PointCloud2>(description, reading);
  EXPECT_EQ(cloud.header.frame_id, "robot/eye");
  ASSERT_EQ(cloud.width, std::uint32_t{kSurveyWidth});
  ASSERT_EQ(cloud.data.size(), 12u * kSurveyWidth * kSurveyHeight);
  for (const auto& [x, y] : {std::pair{0, 0}, {63, 10}, {31, 47}}) {
    float xyz[3];
    std::memcpy(xyz, &cloud.data[12 * (y * kSurveyWidth + x)], sizeof xyz);
    const Vector3 expected = 4 * RayOf(x, y);
    EXPECT_NEAR(xyz[0], expected.x, 1e-4);
    EXPECT_NEAR(xyz[1], expected.y, 1e-4);
    EXPECT_NEAR(xyz[2], expected.z, 1e-4);
  }
}

TEST_F(GroundTruthTest, DepthNoiseHasTheGivenDeviation) {
  Add("wall", geometry::Box{{0.2, 60, 60}}, PlanarPose(4.4, 0, 1, 0));
  auto description = Description("depth");
  description.parameters["noise.stddev"] = 0.05;
  const Reading reading = Sample(description);
  EXPECT_EQ(Sample(description).values.size(), reading.values.size());
  double sum = 0, squares = 0;
  const int n = kSurveyWidth * kSurveyHeight;
  for (int i = 0; i < n; ++i) {
    const double error = reading.values[2 + i] - 4;
    sum += error, squares += error * error;
  }
  EXPECT_WITHIN_3_SIGMA(sum / n, 0, 0.05 / std::sqrt(n));
  EXPECT_WITHIN_3_SIGMA(squares / n, 0.0025, 0.0025 * std::sqrt(2.0 / n));
}

void AddThings(const std::function<void(const char*, geometry::Shape, geometry::Pose)>& add) {
  add("ball", geometry::Sphere{0.5}, PlanarPose(3, 0.8, 1, 0));
  add("box", geometry::Box{{1, 1, 1}}, PlanarPose(4, -1, 1, 0.4));
  add("behind", geometry::Box{{0.2, 8, 8}}, PlanarPose(8, 0, 1, 0));
}

TEST_F(GroundTruthTest, SegmentationAgreesWithRayCasting) {
  AddThings([&](const char* name, geometry::Shape shape, geometry::Pose pose) {
    Add(name, std::move(shape), pose);
  });
  const Reading reading = Sample(Description("segmentation"));
  ASSERT_EQ(reading.labels->size(), 4u);
  const auto scene = rays_.At(snapshot_);
  const int robot = snapshot_->layout->Find("robot");
  int differing = 0;
  for (int y = 0; y < kSurveyHeight; ++y) {
    for (int x = 0; x < kSurveyWidth; ++x) {
      const Vector3 ray = RayOf(x, y);
      const auto hit = scene->Cast({{0.3, 0, 1}, geometry::Normalized(ray), 50}, robot);
      const double expected = hit ? hit->body + 1 : 0;
      differing += reading.values[2 + y * kSurveyWidth + x] != expected;
    }
  }
  // The ball consists of triangles, so a pixel at its rim may miss them.
  EXPECT_WITHIN(differing, 0, 6, "of 3,072 pixels");
}

TEST_F(GroundTruthTest, SegmentationColoursIdentifyLabels) {
  AddThings([&](const char* name, geometry::Shape shape, geometry::Pose pose) {
    Add(name, std::move(shape), pose);
  });
  const auto description = Description("segmentation_camera");
  const Reading reading = Sample(description);
  const auto message = Sent<messages::sensor_msgs::CompressedImage>(description, reading);
  EXPECT_EQ(message.format, "png");
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  ASSERT_NE(png_image_begin_read_from_memory(&png, message.data.data(), message.data.size()), 0);
  png.format = PNG_FORMAT_RGB;
  std::vector<std::uint8_t> pixels(PNG_IMAGE_SIZE(png));
  ASSERT_NE(png_image_finish_read(&png, nullptr, pixels.data(), 0, nullptr), 0);
  std::map<std::uint32_t, double> label_of;
  for (std::size_t i = 0; i < std::size_t{kSurveyWidth} * kSurveyHeight; ++i) {
    const std::uint32_t colour = pixels[3 * i] << 16 | pixels[3 * i + 1] << 8 | pixels[3 * i + 2];
    EXPECT_EQ(label_of.emplace(colour, reading.values[2 + i]).first->second, reading.values[2 + i]);
  }
  EXPECT_EQ(label_of.size(), 4u);  // the background and three objects
}

TEST_F(GroundTruthTest, BoundingBoxEnclosesTheVisiblePixels) {
  // The near face of a box of 1 m is 3 m from the camera. The image of the face's centre is shifted
  // to the right by 1/3 of the focal length. The face's edges are 0.5 / 3 of the focal length on
  // both sides.
  Add("box", geometry::Box{{1, 1, 1}}, PlanarPose(3.8, -1, 1, 0));
  const auto description = Description("boundingbox_camera");
  const Reading reading = Sample(description);
  EXPECT_EQ(*reading.labels, std::vector<std::string>{"box"});
  ASSERT_EQ(reading.values.size(), 4u);
  // The box's left side is also visible. Its far edge is 4 m from the camera.
  EXPECT_WITHIN(reading.values[0], kSurveyWidth / 2.0 + kFocal * 0.5 / 4, 1, "pixel");
  EXPECT_WITHIN(reading.values[1], kSurveyHeight / 2.0 - kFocal * 0.5 / 3, 1, "pixel");
  EXPECT_WITHIN(reading.values[2], kSurveyWidth / 2.0 + kFocal * 1.5 / 3, 1, "pixel");
  EXPECT_WITHIN(reading.values[3], kSurveyHeight / 2.0 + kFocal * 0.5 / 3, 1, "pixel");
  const auto message = Sent<messages::vision_msgs::Detection2DArray>(description, reading);
  ASSERT_EQ(message.detections.size(), 1u);
  EXPECT_EQ(message.detections[0].id, "box");
  EXPECT_NEAR(message.detections[0].bbox.size_y, kFocal / 3, 2);
}

TEST(GroundTruthSensors, ReportWhyThereIsNoRenderer) {
  sensing::SensorRegistry registry;
  ASSERT_TRUE(
      AddGroundTruthSensors(registry, base::Fail(base::ErrorCode::kUnavailable, "no EGL here")));
  TestScene scene;
  scene.Add("robot", geometry::Sphere{0.2}, {}, Matt(1, 1, 1));
  sensing::RaySceneCache rays;
  for (const std::string type :
       {"depth_camera", "segmentation_camera", "boundingbox_camera", "normals_camera"}) {
    model::SensorDescription description;
    description.type = type;
    const auto sensor = registry.Find(type)->create(description);
    ASSERT_TRUE(sensor);
    const auto reading = (*sensor)->Sample(sensing::Sampling(scene.Snapshot(), 0, 1, rays));
    ASSERT_FALSE(reading);
    EXPECT_EQ(reading.error().message, "no EGL here");
    description.parameters["image.width"] = 0.0;
    EXPECT_FALSE(registry.Find(type)->create(description));
  }
}

class ThermalCameraTest : public GroundTruthTest, public ::testing::WithParamInterface<BackEnd> {
 protected:
  ThermalCameraTest() : GroundTruthTest(GetParam()) {}
};

INSTANTIATE_TEST_SUITE_P(BackEnds, ThermalCameraTest,
                         ::testing::Values(BackEnd::kRasteriser, BackEnd::kOpenGl),
                         [](const auto& test) {
                           return test.param == BackEnd::kOpenGl ? "OpenGl" : "Rasteriser";
                         });

// The first visual of a body has a face of 2 m by 1 m, 4 m in front of the camera. To its left is a
// second visual with a face of 1 m by 1 m. To its right is a third visual without a temperature.
TEST_P(ThermalCameraTest, ShowsTheTemperatureOfEachVisualAndOfTheAir) {
  Add("oven", geometry::Box{{1, 2, 1}}, {{4.8, 0, 1}, {}});
  std::vector<model::Visual>& visuals = scene_.LinkOf("oven").visuals;
  visuals[0].temperature = 350;
  model::Visual beside = visuals[0];
  beside.shape = geometry::Box{{1, 1, 1}};
  beside.link_from_visual.position = {0, 1.5, 0};
  beside.temperature = 310.004;
  visuals.push_back(beside);
  beside.link_from_visual.position = {0, -1.5, 0};
  beside.temperature.reset();
  visuals.push_back(beside);
  const Reading reading = Sample(Description("thermal_camera"));
  const auto image = sensing::ValuesOf<readings::ThermalImage>(reading, "eye");
  ASSERT_TRUE(image) << image.error().Sentence();
  ASSERT_EQ(image->width, kSurveyWidth);
  EXPECT_EQ(image->resolution, 0.01);
  int warm = 0, tepid = 0;
  for (int y = 0; y < kSurveyHeight; ++y) {
    for (int x = 0; x < kSurveyWidth; ++x) {
      const Vector3 on_plane = 4 * RayOf(x, y);
      double expected = 288.15;
      if (std::abs(on_plane.z) < 0.5 && std::abs(on_plane.y) < 1) expected = 350, ++warm;
      if (std::abs(on_plane.z) < 0.5 && on_plane.y > 1 && on_plane.y < 2) expected = 310, ++tepid;
      EXPECT_WITHIN(image->temperature[static_cast<std::size_t>(y * kSurveyWidth + x)], expected,
                    1e-9, "K")
          << x << ", " << y;
    }
  }
  EXPECT_GT(warm, 200);
  EXPECT_GT(tepid, 100);

  const auto message =
      Sent<messages::sensor_msgs::CompressedImage>(Description("thermal_camera"), reading);
  EXPECT_EQ(message.format, "mono16; png compressed");
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  ASSERT_TRUE(png_image_begin_read_from_memory(&png, message.data.data(), message.data.size()));
  EXPECT_EQ(png.format, PNG_FORMAT_LINEAR_Y);
  ASSERT_EQ(png.width, unsigned{kSurveyWidth});
  ASSERT_EQ(png.height, unsigned{kSurveyHeight});
  std::vector<std::uint16_t> steps(std::size_t{kSurveyWidth} * kSurveyHeight);
  ASSERT_TRUE(png_image_finish_read(&png, nullptr, steps.data(), 0, nullptr));
  EXPECT_EQ(steps[kSurveyHeight / 2 * kSurveyWidth + kSurveyWidth / 2], 35000);
  EXPECT_EQ(steps[0], 28815);
}

TEST_P(ThermalCameraTest, ReadsResolutionAndAirTemperatureFromTheDescription) {
  scene_.description().temperature = 300.26;
  model::SensorDescription description = Description("thermal_camera");
  description.parameters["resolution"] = 0.5;
  const Reading reading = Sample(description);
  EXPECT_EQ(reading.values[2], 0.5);
  EXPECT_EQ(reading.values[3], 300.5);
}

class NormalsCameraTest : public GroundTruthTest {
 protected:
  // Returns the normal that the camera measures at a pixel; NaN if there is none.
  Vector3 NormalAt(const Reading& reading, int x, int y) {
    const auto image = sensing::ValuesOf<readings::NormalImage>(reading, "eye");
    EXPECT_TRUE(image) << image.error().Sentence();
    const auto first = static_cast<std::size_t>(3 * (y * kSurveyWidth + x));
    return {image->normals[first], image->normals[first + 1], image->normals[first + 2]};
  }
};

TEST_F(NormalsCameraTest, ReturnsTheNormalOfAPlaneAtEveryPixel) {
  const double yaw = 0.5;
  const Vector3 normal{-std::cos(yaw), -std::sin(yaw), 0};
  Add("wall", geometry::Box{{0.2, 60, 60}},
      {Vector3{4, 0, 1} - 0.1 * normal, geometry::FromRollPitchYaw({0, 0, yaw})});
  const Reading reading = Sample(Description("normals_camera"));
  for (int y = 0; y < kSurveyHeight; ++y) {
    for (int x = 0; x < kSurveyWidth; ++x) {
      EXPECT_LT(Norm(NormalAt(reading, x, y) - normal), 1e-3) << x << " " << y;
    }
  }
}

TEST_F(NormalsCameraTest, ReturnsTheNormalOfThePixelsOwnFaceAtAnEdge) {
  // A box has an edge towards the camera, so that two of its faces are visible.
  Add("box", geometry::Box{{2, 2, 40}}, {{4, 0, 1}, geometry::FromRollPitchYaw({0, 0, M_PI / 4})});
  const Reading reading = Sample(Description("normals_camera"));
  const double half = std::sqrt(0.5);
  int left = 0, right = 0;
  for (int x = 0; x < kSurveyWidth; ++x) {
    const Vector3 seen = NormalAt(reading, x, kSurveyHeight / 2);
    if (std::isnan(seen.x)) continue;
    const bool is_left = RayOf(x, 0).y > 0;
    (is_left ? left : right) += 1;
    EXPECT_LT(Norm(seen - Vector3{-half, is_left ? half : -half, 0}), 1e-3) << x;
  }
  EXPECT_GT(left, 8);
  EXPECT_GT(right, 8);
}

TEST_F(NormalsCameraTest, ReturnsTheNormalsOfASphereAndNanForTheSky) {
  const Vector3 centre{4, 0, 1};
  Add("ball", geometry::Sphere{1}, {centre, {}});
  const Reading reading = Sample(Description("normals_camera"));
  const auto depth = Sample(Description("depth_camera"));
  int seen = 0;
  for (int y = 0; y < kSurveyHeight; ++y) {
    for (int x = 0; x < kSurveyWidth; ++x) {
      const double d = depth.values[static_cast<std::size_t>(2 + y * kSurveyWidth + x)];
      const Vector3 normal = NormalAt(reading, x, y);
      if (!std::isfinite(d)) {
        EXPECT_TRUE(std::isnan(normal.x)) << x << " " << y;
        continue;
      }
      const Vector3 expected = Vector3{0.3, 0, 1} + d * RayOf(x, y) - centre;
      // The tolerance, 0.12 rad, is for the angle between the measured and the exact normal. The
      // sphere consists of facets, which are 0.1 rad wide. The normal is computed from adjacent
      // pixels, which are 0.07 m or 0.07 rad of the sphere apart. The maximum error about one axis
      // is (0.1 + 0.07) / 2 = 0.085 rad. For two axes, it is sqrt(2) times as large: 0.12 rad.
      if (expected.x > -0.75) continue;
      EXPECT_LT(Norm(normal - expected), 0.12) << x << " " << y;
      ++seen;
    }
  }
  EXPECT_GT(seen, 200);

  const auto message =
      Sent<messages::sensor_msgs::CompressedImage>(Description("normals_camera"), reading);
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  ASSERT_TRUE(png_image_begin_read_from_memory(&png, message.data.data(), message.data.size()));
  png.format = PNG_FORMAT_RGB;
  std::vector<std::uint8_t> pixels(PNG_IMAGE_SIZE(png));
  ASSERT_TRUE(png_image_finish_read(&png, nullptr, pixels.data(), 0, nullptr));
  EXPECT_EQ(pixels[0] + pixels[1] + pixels[2], 0);
  const std::size_t middle = 3 * (kSurveyHeight / 2 * kSurveyWidth + kSurveyWidth / 2);
  EXPECT_LE(pixels[middle], 2);  // the normal points towards the camera: x = -1
}

}  // namespace
}  // namespace gsv::rendering
