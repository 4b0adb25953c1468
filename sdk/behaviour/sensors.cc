#include "sdk/behaviour/sensors.h"

#include <algorithm>

#include "gsv/base/base64.h"

namespace gsv {
namespace {

constexpr double kSonarMaximum = 5;  // m, where its parameters do not say

Vector VectorAt(const std::vector<double>& v, std::size_t place) {
  return {v[place], v[place + 1], v[place + 2]};
}

Placement PlacementAt(const std::vector<double>& v, std::size_t place) {
  return {v[place], v[place + 1], v[place + 2], v[place + 3], v[place + 4], v[place + 5]};
}

// How many labelled groups of `size` values a reading holds.
std::size_t GroupsOf(const Reading& reading, std::size_t size) {
  return std::min(reading.labels.size(), reading.values.size() / size);
}

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
  const Reading& reading = Measure();
  return reading.values.empty() ? max_range_ : reading.values.front();
}

Placement PositioningSystem::Locate() {
  const std::vector<double>& v = Measure().values;
  return v.size() == 6 ? PlacementAt(v, 0) : Placement{};
}

Imu::Motion Imu::Feel() {
  const std::vector<double>& v = Measure().values;
  return v.size() >= 6 ? Motion{VectorAt(v, 0), VectorAt(v, 3)} : Motion{};
}

Odometer::Estimate Odometer::Reckon() {
  const std::vector<double>& v = Measure().values;
  return v.size() == 5 ? Estimate{v[0], v[1], v[2], v[3], v[4]} : Estimate{};
}

SatelliteReceiver::Position SatelliteReceiver::Fix() {
  const std::vector<double>& v = Measure().values;
  return v.size() == 6 ? Position{v[0], v[1], v[2], v[3], v[4], v[5]} : Position{};
}

Vector Magnetometer::Field() {
  const std::vector<double>& v = Measure().values;
  return v.size() == 3 ? VectorAt(v, 0) : Vector{};
}

Altimeter::Height Altimeter::Measured() {
  const std::vector<double>& v = Measure().values;
  return v.size() == 3 ? Height{v[0], v[1], v[2]} : Height{};
}

std::vector<Bumper::Touch> Bumper::Touches() {
  const Reading& reading = Measure();
  std::vector<Touch> touches;
  for (std::size_t i = 0; i < GroupsOf(reading, 8); ++i) {
    touches.push_back({reading.labels[i], VectorAt(reading.values, 8 * i),
                       VectorAt(reading.values, 8 * i + 3), reading.values[8 * i + 6],
                       reading.values[8 * i + 7]});
  }
  return touches;
}

std::vector<JointEncoders::Joint> JointEncoders::Joints() {
  const Reading& reading = Measure();
  std::vector<Joint> joints;
  for (std::size_t i = 0; i < GroupsOf(reading, 2); ++i) {
    joints.push_back({reading.labels[i], reading.values[2 * i], reading.values[2 * i + 1]});
  }
  return joints;
}

Battery::Charge Battery::Level() {
  const std::vector<double>& v = Measure().values;
  return v.size() == 5 ? Charge{v[0], v[1], v[2], v[3], v[4]} : Charge{};
}

std::vector<LogicalCamera::Sighting> LogicalCamera::Look() {
  const Reading& reading = Measure();
  std::vector<Sighting> sightings;
  for (std::size_t i = 0; i < GroupsOf(reading, 6); ++i) {
    sightings.push_back({reading.labels[i], PlacementAt(reading.values, 6 * i)});
  }
  return sightings;
}

std::vector<Radio::Message> Radio::Receive() {
  const Reading& reading = Measure();
  std::vector<Message> messages;
  const std::size_t count = std::min(reading.labels.size() / 2, reading.values.size() / 3);
  for (std::size_t i = 0; i < count; ++i) {
    const double* const v = &reading.values[3 * i];
    const auto number = static_cast<std::uint64_t>(v[0]);
    auto content = base::FromBase64(reading.labels[2 * i + 1]);
    if (number <= received_ || !content) continue;
    missed_ += number - received_ - 1;
    received_ = number;
    messages.push_back({reading.labels[2 * i], *std::move(content), base::FromSeconds(v[1]), v[2]});
  }
  return messages;
}

DepthCamera::Image DepthCamera::TakeDepth() {
  const std::vector<double>& v = Measure().values;
  if (v.size() < 2) return {};
  return {static_cast<int>(v[0]), static_cast<int>(v[1]), {v.begin() + 2, v.end()}};
}

SegmentationCamera::Image SegmentationCamera::Segment() {
  const Reading& reading = Measure();
  const std::vector<double>& v = reading.values;
  if (v.size() < 2) return {};
  return {static_cast<int>(v[0]), static_cast<int>(v[1]), {v.begin() + 2, v.end()}, reading.labels};
}

std::vector<BoundingBoxCamera::Box> BoundingBoxCamera::Detect() {
  const Reading& reading = Measure();
  std::vector<Box> boxes;
  for (std::size_t i = 0; i < GroupsOf(reading, 4); ++i) {
    const double* const v = &reading.values[4 * i];
    boxes.push_back({reading.labels[i], v[0], v[1], v[2], v[3]});
  }
  return boxes;
}

}  // namespace gsv
