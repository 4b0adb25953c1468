#include "gsv/gateway/testing/arena.h"

#include <numbers>

#include <turbojpeg.h>

#include "gsv/messages/sensor_msgs.h"
#include "gsv/sensing/sensor_type.h"

namespace gsv::gateway::testing {
namespace {

using geometry::Pose;

model::Material Painted(double r, double g, double b) {
  model::Material material;
  material.base_colour = {r, g, b, 1};
  return material;
}

// Adds a part whose shape is both its visual and its collision.
void AddPart(model::Link& link, const geometry::Shape& shape, const Pose& link_from_part,
             const model::Material& material) {
  const std::string name = "part_" + std::to_string(link.visuals.size());
  link.visuals.push_back({name, link_from_part, shape, {material}, true});
  link.collisions.push_back({name, link_from_part, shape, {}});
}

model::Model StaticModel(std::string name) {
  model::Model model;
  model.name = std::move(name);
  model.is_static = true;
  model.links.resize(1);
  model.links[0].name = "link";
  return model;
}

model::SensorDescription SensorAt(std::string name, std::string type, double x, double z,
                                  double yaw) {
  model::SensorDescription sensor;
  sensor.name = std::move(name);
  sensor.type = std::move(type);
  sensor.link_from_sensor = geometry::PlanarPose(x, 0, z, yaw);
  return sensor;
}

void AddWheel(model::Model& robot, const std::string& side, double y) {
  model::Link wheel;
  wheel.name = side + "_wheel";
  wheel.model_from_link.position = {0, y, 0.1};
  const Pose upright{{}, geometry::FromRollPitchYaw({std::numbers::pi / 2, 0, 0})};
  AddPart(wheel, geometry::Cylinder{0.1, 0.04}, upright, Painted(0.1, 0.1, 0.1));
  AddPart(wheel, geometry::Box{{0.16, 0.045, 0.02}}, {}, Painted(0.9, 0.9, 0.2));
  model::Joint joint;
  joint.name = side + "_wheel_joint";
  joint.kind = model::JointKind::kContinuous;
  joint.parent = 0;
  joint.child = static_cast<int>(robot.links.size());
  joint.model_from_joint = wheel.model_from_link;
  joint.axis = {0, 1, 0};
  robot.links.push_back(std::move(wheel));
  robot.joints.push_back(std::move(joint));
}

class GradientCamera final
    : public sensing::SensorOf<readings::Camera, messages::sensor_msgs::CompressedImage> {
 public:
  GradientCamera(const model::SensorDescription& description, sensing::ParameterReader&)
      : SensorOf(description) {}

  base::Result<sensing::Reading> Sample(const sensing::Sampling& sampling) const override {
    auto image = std::make_shared<model::Image>();
    image->width = kWidth;
    image->height = kHeight;
    image->pixels.resize(3u * kWidth * kHeight);
    const auto shade = static_cast<std::uint8_t>(sampling.snapshot()->state.step);
    for (int y = 0; y < kHeight; ++y) {
      for (int x = 0; x < kWidth; ++x) {
        std::uint8_t* pixel = &image->pixels[3u * (y * kWidth + x)];
        pixel[0] = static_cast<std::uint8_t>(x * 255 / (kWidth - 1));
        pixel[1] = static_cast<std::uint8_t>(y * 255 / (kHeight - 1));
        pixel[2] = shade;
      }
    }
    sensing::Reading reading = sampling.Stamped();
    Fill(Values{kWidth, kHeight}, reading);
    reading.image = std::move(image);
    return reading;
  }
  std::optional<sensing::Frustum> frustum() const override {
    return sensing::Frustum{1.047, double{kWidth} / kHeight};
  }
  Bytes EncodeCompanion(base::SimTime time, const std::string& frame_id) const override {
    messages::sensor_msgs::CameraInfo message;
    message.header = sensing::HeaderOf(time, frame_id);
    return sensing::Encoded(message);
  }

 private:
  static constexpr int kWidth = 320, kHeight = 240;

  Message ToMessage(const Values&, const sensing::Reading& reading,
                    const std::string&) const override {
    Message message;
    message.format = "jpeg";
    unsigned char* jpeg = nullptr;
    unsigned long size = 0;
    const tjhandle compressor = tjInitCompress();
    tjCompress2(compressor, reading.image->pixels.data(), kWidth, 0, kHeight, TJPF_RGB, &jpeg,
                &size, TJSAMP_420, 85, 0);
    message.data.assign(jpeg, jpeg + size);
    tjFree(jpeg);
    tjDestroy(compressor);
    return message;
  }
};

}  // namespace

model::Model FloorModel() {
  model::Model model = StaticModel("floor");
  AddPart(model.links[0], geometry::Plane{{0, 0, 1}, {20, 20}}, {}, Painted(0.55, 0.6, 0.55));
  return model;
}

model::Model CrateModel() {
  model::Model model = StaticModel("crate");
  AddPart(model.links[0], geometry::Box{{1, 1, 1}}, geometry::PlanarPose(0, 0, 0.5, 0),
          Painted(0.6, 0.4, 0.2));
  return model;
}

model::Model RobotModel() {
  model::Model robot;
  robot.name = "circler";
  robot.links.resize(1);
  robot.links[0].name = "base";
  AddPart(robot.links[0], geometry::Box{{0.5, 0.3, 0.2}}, geometry::PlanarPose(0, 0, 0.2, 0),
          Painted(0.8, 0.2, 0.2));
  AddPart(robot.links[0], geometry::Box{{0.1, 0.1, 0.1}}, geometry::PlanarPose(0.15, 0, 0.35, 0),
          Painted(0.2, 0.2, 0.8));
  AddWheel(robot, "left", 0.17);
  AddWheel(robot, "right", -0.17);
  robot.drive.emplace();
  robot.drive->left_wheels = {0};
  robot.drive->right_wheels = {1};
  robot.sensors = {SensorAt("front_sonar", "sonar", 0.25, 0.2, 0),
                   SensorAt("left_sonar", "sonar", 0, 0.2, std::numbers::pi / 2),
                   SensorAt("lidar", "lidar", 0, 0.45, 0),
                   SensorAt("camera", "camera", 0.2, 0.35, 0)};
  return robot;
}

model::WorldDescription ArenaDescription() {
  model::WorldDescription world;
  world.name = "arena";
  world.max_step_size = std::chrono::milliseconds(10);
  model::Light sun;
  sun.name = "sun";
  sun.direction = geometry::Normalized(geometry::Vector3{0.4, 0.2, -0.9});
  world.lights.push_back(sun);
  return world;
}

sensing::SensorType GradientCameraType() {
  auto type = sensing::MakeSensorType<GradientCamera>(readings::Camera::kType, {},
                                                      sensing::Overlay::kImage);
  type.companion = {"camera_info", &messages::SchemaOf<messages::sensor_msgs::CameraInfo>()};
  return type;
}

}  // namespace gsv::gateway::testing
