#include "sdk/behaviour/sensors.h"

#include "gsv/base/base64.h"

namespace gsv {
namespace {

constexpr double kSonarMaximum = 5;  // in m; used if the parameters of the sonar do not set it

}  // namespace

double Sensor::Number(const std::string& parameter, double otherwise) const {
  const auto found = traits().parameters.find(parameter);
  if (found == traits().parameters.end()) return otherwise;
  const double* const value = std::get_if<double>(&found->second);
  return value != nullptr ? *value : otherwise;
}

Sonar::Sonar(std::unique_ptr<SensorPort> port)
    : Sensor(std::move(port)), max_range_(Number("max", kSonarMaximum)) {}

double Sonar::Range() {
  const auto sonar = In<readings::Sonar>(Measure());
  return sonar ? sonar->range : max_range_;
}

Lidar::Scan Lidar::Read() {
  auto scan = MeasureAs<readings::Lidar>();
  if (Number(readings::Lidar::kIntensityParameter, 0) > 0) scan = scan.WithIntensities();
  return {{scan.ranges.begin(), scan.ranges.end()},
          {scan.intensities.begin(), scan.intensities.end()}};
}

const std::vector<double>& Lidar::Ranges() {
  if (!(Number(readings::Lidar::kIntensityParameter, 0) > 0)) return Measure().values;
  ranges_ = Read().ranges;
  return ranges_;
}

Placement PositioningSystem::Locate() {
  return MeasureAs<readings::Positioning>().world_from_sensor;
}

Imu::Motion Imu::Read() { return MeasureAs<Motion>(); }

Odometer::Estimate Odometer::Read() { return MeasureAs<Estimate>(); }

GnssReceiver::Position GnssReceiver::Fix() { return MeasureAs<Position>(); }

Vector Magnetometer::Field() { return MeasureAs<readings::Magnetometer>().field; }

Altimeter::Height Altimeter::Measured() { return MeasureAs<Height>(); }

std::vector<Bumper::Touch> Bumper::Touches() { return MeasureAs<readings::Contact>().touches; }

ForceTorque::Wrench ForceTorque::Read() { return MeasureAs<readings::ForceTorque>(); }

std::vector<JointEncoders::Joint> JointEncoders::Joints() {
  return MeasureAs<readings::JointEncoders>().joints;
}

Battery::Charge Battery::Level() { return MeasureAs<Charge>(); }

std::vector<LogicalCamera::Sighting> LogicalCamera::Read() {
  return MeasureAs<readings::LogicalCamera>().sightings;
}

std::vector<Radio::Message> Radio::Receive() {
  std::vector<Message> messages;
  for (const readings::HeardMessage& heard : MeasureAs<readings::Radio>().messages) {
    auto content = base::FromBase64(heard.content_base64);
    if (heard.number <= received_ || !content) continue;
    missed_ += heard.number - received_ - 1;
    received_ = heard.number;
    messages.push_back(
        {heard.sender, *std::move(content), base::FromSeconds(heard.sent), heard.strength});
  }
  return messages;
}

double Ranging::Distance() { return MeasureAs<readings::Ranging>().distance; }

DepthCamera::Image DepthCamera::TakeDepth() {
  const auto image = MeasureAs<readings::DepthImage>();
  return {image.width, image.height, {image.depth.begin(), image.depth.end()}};
}

SegmentationCamera::Image SegmentationCamera::Segment() {
  const auto image = MeasureAs<readings::SegmentedImage>();
  return {image.width,
          image.height,
          {image.pixels.begin(), image.pixels.end()},
          {image.names.begin(), image.names.end()}};
}

ThermalCamera::Image ThermalCamera::TakeTemperatures() {
  const auto image = MeasureAs<readings::ThermalImage>();
  return {image.width,
          image.height,
          image.resolution,
          {image.temperature.begin(), image.temperature.end()}};
}

NormalsCamera::Image NormalsCamera::TakeNormals() {
  const auto image = MeasureAs<readings::NormalImage>();
  return {image.width, image.height, {image.normals.begin(), image.normals.end()}};
}

std::vector<BoundingBoxCamera::Box> BoundingBoxCamera::Detect() {
  return MeasureAs<readings::BoundingBoxes>().boxes;
}

}  // namespace gsv
