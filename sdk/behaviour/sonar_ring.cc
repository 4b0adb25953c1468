#include "sdk/behaviour/sonar_ring.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace gsv {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kMountedMin = 0.05;  // m
constexpr double kMountedMax = 5.0;   // m
// height above the origin in m; low enough to detect low furniture
constexpr double kMountedHeight = 0.12;

double AngleBetween(double a, double b) { return std::abs(std::remainder(a - b, 2 * kPi)); }

}  // namespace

base::Result<SonarRing> SonarRing::Open(Robot& robot, int count) {
  std::vector<SensorTraits> sonars = robot.Sensors();
  std::erase_if(sonars, [](const SensorTraits& traits) { return traits.type != "sonar"; });
  SonarRing ring;
  for (int i = 0; i < count; ++i) {
    const double bearing = std::remainder(i * 2 * kPi / count, 2 * kPi);
    if (sonars.empty()) {
      Placement mounting;
      mounting.z = kMountedHeight;
      mounting.yaw = bearing;
      const std::string name = "ring_" + std::to_string(i);
      auto sonar = robot.CreateSonar(name, mounting, kMountedMin, kMountedMax);
      if (!sonar) return base::Fail(sonar.error());
      ring.sonars_.push_back({name, *std::move(sonar), bearing, 0.0});
      continue;
    }
    const auto nearest = std::min_element(sonars.begin(), sonars.end(),
                                          [&](const SensorTraits& a, const SensorTraits& b) {
                                            return AngleBetween(a.robot_from_sensor.yaw, bearing) <
                                                   AngleBetween(b.robot_from_sensor.yaw, bearing);
                                          });
    const Placement& mounting = nearest->robot_from_sensor;
    auto sonar = robot.OpenSonar(nearest->name);
    if (!sonar) return base::Fail(sonar.error());
    ring.sonars_.push_back(
        {nearest->name, *std::move(sonar), mounting.yaw, std::hypot(mounting.x, mounting.y)});
  }
  return ring;
}

std::vector<SonarRing::Echo> SonarRing::Read() {
  std::vector<Echo> echoes;
  for (const Mounted& mounted : sonars_) {
    const double range = mounted.sonar->Range();
    echoes.push_back({mounted.bearing, mounted.offset + range, range < mounted.sonar->max_range()});
  }
  return echoes;
}

std::vector<SonarRing::Echo> SonarRing::From(const std::vector<Reading>& readings) const {
  std::vector<Echo> echoes;
  for (const Mounted& mounted : sonars_) {
    const auto reading = std::find_if(readings.begin(), readings.end(), [&](const Reading& each) {
      return each.sensor == mounted.name && !each.values.empty();
    });
    if (reading == readings.end()) continue;
    const double range = reading->values.front();
    echoes.push_back({mounted.bearing, mounted.offset + range, range < mounted.sonar->max_range()});
  }
  return echoes;
}

double Nearest(const std::vector<SonarRing::Echo>& echoes, double bearing, double half_angle) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const SonarRing::Echo& echo : echoes) {
    if (AngleBetween(echo.bearing, bearing) <= half_angle)
      nearest = std::min(nearest, echo.distance);
  }
  return nearest;
}

}  // namespace gsv
