// The description of a sensor, from a model file or a SensorFactory call.
#pragma once

#include <map>
#include <string>
#include <variant>

#include "gsv/geometry/pose.h"

namespace gsv::model {

// Parameters by name; docs/sensors.md lists the parameters of each sensor type. A nested element of
// SDFormat becomes a dotted name ("horizontal.samples") with the unit of SDFormat (metres, radians,
// hertz).
using ParameterValue = std::variant<double, bool, std::string>;
using Parameters = std::map<std::string, ParameterValue>;

struct SensorDescription {
  std::string name;  // unique on its robot
  std::string type;  // "sonar", "camera", "positioning", "lidar", …
  int link = 0;      // index of the link it is mounted on
  geometry::Pose link_from_sensor;
  double update_rate = 0;  // Hz; 0 means a sample at each request, at most one per step
  bool visualize = false;  // whether viewers draw the readings
  Parameters parameters;

  friend bool operator==(const SensorDescription&, const SensorDescription&) = default;
};

// Each function returns the parameter, or `otherwise` if it is absent or has another type.
double NumberOr(const Parameters& parameters, const std::string& name, double otherwise);
bool FlagOr(const Parameters& parameters, const std::string& name, bool otherwise);
std::string TextOr(const Parameters& parameters, const std::string& name, std::string otherwise);

}  // namespace gsv::model
