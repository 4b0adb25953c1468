// Compares the lens parameters of a camera with its images.
#include "gsv/rendering/cameras/camera_info.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "gsv/base/test_within.h"
#include "gsv/messages/sensor_msgs.h"
#include "gsv/rendering/cameras/camera_sensor.h"
#include "gsv/rendering/cameras/optics.h"

namespace gsv::rendering {
namespace {

using messages::sensor_msgs::CameraInfo;

model::SensorDescription CameraWith(model::Parameters parameters) {
  model::SensorDescription description;
  description.name = "front";
  description.type = "camera";
  description.parameters = std::move(parameters);
  return description;
}

CameraInfo InfoFor(const model::SensorDescription& description) {
  sensing::ParameterReader reader(description);
  const auto bytes =
      EncodeCameraInfo(Optics::Read(reader).lens(), std::chrono::milliseconds(1250), "robot/front");
  const auto info = messages::Decode<CameraInfo>(std::as_bytes(std::span(bytes)));
  EXPECT_TRUE(info);
  return info ? *info : CameraInfo();
}

Lens LensFor(const model::SensorDescription& description) {
  sensing::ParameterReader reader(description);
  return Optics::Read(reader).lens();
}

// Projects a point in the optical frame with the equations of ROS and OpenCV.
geometry::Vector2 PlumbBob(const CameraInfo& info, double x, double y, double z) {
  x /= z, y /= z;
  const double r2 = x * x + y * y;
  const double k1 = info.d[0], k2 = info.d[1], p1 = info.d[2], p2 = info.d[3], k3 = info.d[4];
  const double radial = 1 + k1 * r2 + k2 * r2 * r2 + k3 * r2 * r2 * r2;
  const double u = x * radial + 2 * p1 * x * y + p2 * (r2 + 2 * x * x);
  const double v = y * radial + p1 * (r2 + 2 * y * y) + 2 * p2 * x * y;
  return {info.k[0] * u + info.k[1] * v + info.k[2], info.k[4] * v + info.k[5]};
}

TEST(CameraInfo, OfAPinholeIsComputedFromTheFieldOfView) {
  const CameraInfo info = InfoFor(
      CameraWith({{"image.width", 640.0}, {"image.height", 480.0}, {"horizontal_fov", 1.2}}));
  const double f = 320 / std::tan(0.6);
  EXPECT_EQ(info.width, 640u);
  EXPECT_EQ(info.height, 480u);
  EXPECT_EQ(info.distortion_model, "plumb_bob");
  EXPECT_EQ(info.d, (std::vector<double>{0, 0, 0, 0, 0}));
  const double k[] = {f, 0, 320, 0, f, 240, 0, 0, 1};
  const double p[] = {f, 0, 320, 0, 0, f, 240, 0, 0, 0, 1, 0};
  for (int i = 0; i < 9; ++i) EXPECT_WITHIN(info.k[i], k[i], 1e-9, "pixel") << i;
  for (int i = 0; i < 12; ++i) EXPECT_WITHIN(info.p[i], p[i], 1e-9, "pixel") << i;
  EXPECT_EQ(info.header.frame_id, "robot/front/optical");
  EXPECT_EQ(info.header.stamp.sec, 1);
  EXPECT_EQ(info.header.stamp.nanosec, 250'000'000u);
}

TEST(CameraInfo, RosEquationsProjectToTheSamePixels) {
  const auto description = CameraWith({{"image.width", 640.0},
                                       {"image.height", 480.0},
                                       {"lens.intrinsics.fx", 500.0},
                                       {"lens.intrinsics.fy", 510.0},
                                       {"lens.intrinsics.cx", 320.0},
                                       {"lens.intrinsics.cy", 240.0},
                                       {"lens.intrinsics.s", 1.5},
                                       {"distortion.k1", -0.28},
                                       {"distortion.k2", 0.07},
                                       {"distortion.k3", 0.01},
                                       {"distortion.p1", 0.0011},
                                       {"distortion.p2", -0.0004}});
  const CameraInfo info = InfoFor(description);
  ASSERT_EQ(info.distortion_model, "plumb_bob");
  ASSERT_EQ(info.d.size(), 5u);
  const Lens lens = LensFor(description);
  for (const double left : {-1.0, 0.2, 0.9}) {
    for (const double up : {-0.8, 0.1, 0.7}) {
      const auto shown = lens.Project({3, left, up});
      ASSERT_TRUE(shown);
      const geometry::Vector2 said = PlumbBob(info, -left, -up, 3);
      EXPECT_WITHIN(said.x, shown->x, 1e-9, "pixel");
      EXPECT_WITHIN(said.y, shown->y, 1e-9, "pixel");
    }
  }
}

TEST(CameraInfo, OfAnEquidistantLensContainsPixelsPerRadian) {
  const auto description = CameraWith({{"image.width", 600.0},
                                       {"image.height", 400.0},
                                       {"horizontal_fov", std::numbers::pi},
                                       {"lens.type", std::string("equidistant")}});
  const CameraInfo info = InfoFor(description);
  EXPECT_EQ(info.distortion_model, "equidistant");
  EXPECT_EQ(info.d, (std::vector<double>{0, 0, 0, 0}));
  // Half of the width, 300 pixels, shows a quarter of a turn.
  EXPECT_WITHIN(info.k[0], 300 / (std::numbers::pi / 2), 1e-9, "pixel");
  const auto at_one_radian = LensFor(description).Project({std::cos(1), -std::sin(1), 0});
  ASSERT_TRUE(at_one_radian);
  EXPECT_WITHIN(at_one_radian->x, info.k[2] + info.k[0], 1e-9, "pixel");
}

TEST(CameraInfo, IsZeroForLensesWithoutARosModel) {
  const std::string stereographic = "stereographic", corner = "0 0";
  for (const model::Parameters& parameters :
       std::vector<model::Parameters>{{{"lens.type", stereographic}, {"horizontal_fov", 2.0}},
                                      {{"distortion.k1", -0.1}, {"distortion.center", corner}}}) {
    const CameraInfo info = InfoFor(CameraWith(parameters));
    EXPECT_EQ(info.distortion_model, "");
    EXPECT_TRUE(info.d.empty());
    EXPECT_EQ(info.k[0], 0);
    EXPECT_EQ(info.width, 320u);
  }
}

TEST(CameraInfo, IsTheCompanionMessageOfEveryCamera) {
  sensing::SensorRegistry registry;
  ASSERT_TRUE(AddCameraSensor(registry, nullptr));
  for (const char* name : {"camera", "wideangle_camera"}) {
    ASSERT_TRUE(registry.Find(name)->companion) << name;
    EXPECT_EQ(registry.Find(name)->companion->topic, "camera_info");
  }
  // A wide-angle camera without a <lens> is stereographic.
  const auto wide = registry.Find("wideangle_camera")->create(CameraWith({}));
  ASSERT_TRUE(wide);
  const auto bytes = (*wide)->EncodeCompanion({}, "robot/wide");
  const auto info = messages::Decode<CameraInfo>(std::as_bytes(std::span(bytes)));
  ASSERT_TRUE(info);
  EXPECT_EQ(info->distortion_model, "");
}

}  // namespace
}  // namespace gsv::rendering
