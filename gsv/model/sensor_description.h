// A sensor as a model file or a caller of the SensorFactory describes it.
#pragma once

#include <map>
#include <string>
#include <variant>

#include "gsv/geometry/pose.h"

namespace gsv::model {

// Parameters by name; each sensor type documents its own. From SDFormat a nested element becomes a
// dotted name ("horizontal.samples"), its unit that of SDFormat (metres, radians, hertz).
using ParameterValue = std::variant<double, bool, std::string>;
using Parameters = std::map<std::string, ParameterValue>;

struct SensorDescription {
  std::string name;  // unique on its robot
  std::string type;  // "sonar", "camera", "positioning", "lidar", …
  int link = 0;      // index of the link it is mounted on
  geometry::Pose link_from_sensor;
  double update_rate = 0;  // Hz; 0: samples whenever asked, at most once a step
  bool visualize = false;  // the file asks for the readings to be drawn
  Parameters parameters;

  friend bool operator==(const SensorDescription&, const SensorDescription&) = default;
};

// The parameter as a number or a flag; `otherwise` when it is absent or of another kind.
double NumberOr(const Parameters& parameters, const std::string& name, double otherwise);
bool FlagOr(const Parameters& parameters, const std::string& name, bool otherwise);
std::string TextOr(const Parameters& parameters, const std::string& name, std::string otherwise);

}  // namespace gsv::model
