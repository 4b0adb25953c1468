#include "gsv/rendering/cameras/camera_sensor.h"

#include <memory>
#include <type_traits>

#include <gtest/gtest.h>
#include <turbojpeg.h>

#include "gsv/messages/cdr.h"
#include "gsv/messages/sensor_msgs.h"
#include "gsv/rendering/testing/test_scene.h"

namespace gsv::rendering {
namespace {

model::SensorDescription Front(model::Parameters parameters = {}) {
  model::SensorDescription description;
  description.name = "front";
  description.type = "camera";
  description.link_from_sensor.position = {0.5, 0, 0};
  description.parameters = std::move(parameters);
  return description;
}

struct Fixture {
  explicit Fixture(base::Result<std::shared_ptr<Renderer>> renderer) {
    EXPECT_TRUE(AddCameraSensor(registry, std::move(renderer)));
  }
  sensing::SensorRegistry registry;
  sensing::RaySceneCache rays;
  const sensing::SensorType& type() { return *registry.Find("camera"); }
};

TEST(Camera, TakesAnImageFromItsMountingPose) {
  Fixture fixture(Renderer::Start());
  const auto camera = fixture.type().create(
      Front({{"image.width", 64.0}, {"image.height", 48.0}, {"horizontal_fov", 1.5}}));
  ASSERT_TRUE(camera) << camera.error().Sentence();
  TestScene scene;
  // The robot faces the world's y axis; its camera is in front of its own body.
  scene.Add("robot", geometry::Box{{0.8, 0.8, 0.8}}, geometry::PlanarPose(2, 0, 1, 1.5707963),
            Glowing(0, 0, 1));
  scene.Add("target", geometry::Sphere{0.3}, {{2, 3, 1}, {}}, Glowing(1, 0, 0));
  const auto snapshot = scene.Snapshot();
  const auto reading = (*camera)->Sample(
      sensing::Sampling(snapshot, snapshot->layout->Find("robot"), 1, fixture.rays));
  ASSERT_TRUE(reading) << reading.error().Sentence();
  EXPECT_EQ(reading->values, (sensing::Reading::Values{64, 48}));
  ASSERT_NE(reading->image, nullptr);
  const Blob target = FindBlob(*reading->image, 0);
  EXPECT_GT(target.pixels, 10);
  EXPECT_NEAR(target.u, 32, 0.5);
  EXPECT_NEAR(target.v, 24, 0.5);
  EXPECT_EQ(FindBlob(*reading->image, 2).pixels, 0);
}

TEST(Camera, BecomesAJpegMessage) {
  Fixture fixture(nullptr);
  auto image = std::make_shared<model::Image>();
  image->width = 32, image->height = 16;
  for (int i = 0; i < 32 * 16; ++i) image->pixels.insert(image->pixels.end(), {200, 100, 50});
  sensing::Reading reading;
  reading.time = std::chrono::milliseconds(1500);
  reading.values = {32, 16};
  reading.image = image;
  const auto bytes = (*fixture.type().create(Front()))->Encode(reading, "robot/front");
  ASSERT_TRUE(bytes);
  const auto message =
      messages::Decode<messages::sensor_msgs::CompressedImage>(std::as_bytes(std::span(*bytes)));
  ASSERT_TRUE(message) << message.error().Sentence();
  EXPECT_EQ(message->format, "jpeg");
  EXPECT_EQ(message->header.frame_id, "robot/front");
  EXPECT_EQ(message->header.stamp.sec, 1);
  EXPECT_EQ(message->header.stamp.nanosec, 500'000'000u);
  EXPECT_EQ(fixture.type().schema->name, "sensor_msgs/msg/CompressedImage");

  const std::unique_ptr<std::remove_pointer_t<tjhandle>, int (*)(tjhandle)> decoder(
      tjInitDecompress(), tjDestroy);
  std::vector<std::uint8_t> back(32 * 16 * 3);
  ASSERT_EQ(tjDecompress2(decoder.get(), message->data.data(), message->data.size(), back.data(),
                          32, 0, 16, TJPF_RGB, 0),
            0);
  EXPECT_NEAR(back[0], 200, 4);
  EXPECT_NEAR(back[1], 100, 4);
  EXPECT_NEAR(back[2], 50, 4);
}

TEST(Camera, RejectsInvalidImageParameters) {
  Fixture fixture(nullptr);
  for (const auto& [name, value] : {std::pair{"image.width", 0.0},
                                    {"image.width", 100000.0},
                                    {"image.height", -3.0},
                                    {"image.height", 2.5},
                                    {"horizontal_fov", 0.0},
                                    {"horizontal_fov", 6.28},
                                    {"clip.near", 0.0},
                                    {"clip.near", 200.0},
                                    {"clip.far", 0.01}}) {
    const auto camera = fixture.type().create(Front({{name, value}}));
    ASSERT_FALSE(camera) << name << " " << value;
    EXPECT_NE(camera.error().Sentence().find(name), std::string::npos) << camera.error().Sentence();
  }
}

TEST(Camera, ReportsWhyThereIsNoRenderer) {
  Fixture fixture(base::Fail(base::ErrorCode::kUnavailable, "there is no EGL here"));
  const auto camera = fixture.type().create(Front());
  ASSERT_TRUE(camera);
  TestScene scene;
  scene.Add("robot", geometry::Box{}, {}, {});
  const auto reading = (*camera)->Sample(sensing::Sampling(scene.Snapshot(), 0, 1, fixture.rays));
  ASSERT_FALSE(reading);
  EXPECT_EQ(reading.error().code, base::ErrorCode::kUnavailable);
  EXPECT_EQ(reading.error().message, "there is no EGL here");
}

TEST(Camera, FailsIfTheRendererIsNull) {
  Fixture fixture(nullptr);
  const auto camera = fixture.type().create(Front());
  ASSERT_TRUE(camera);
  TestScene scene;
  scene.Add("robot", geometry::Box{}, {}, {});
  EXPECT_FALSE((*camera)->Sample(sensing::Sampling(scene.Snapshot(), 0, 1, fixture.rays)));
}

TEST(Camera, ReadingIsShownToViewersAsAnImage) {
  Fixture fixture(nullptr);
  EXPECT_EQ(fixture.type().overlay, sensing::Overlay::kImage);
}

}  // namespace
}  // namespace gsv::rendering
