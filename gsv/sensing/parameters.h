// Sensor parameters, checked as they are read.
#pragma once

#include <limits>
#include <string>

#include "gsv/base/error.h"
#include "gsv/geometry/vector3.h"
#include "gsv/model/sensor_description.h"

namespace gsv::sensing {

// Reads one sensor's parameters; remembers the first that cannot be, so that a reader asks once, at
// the end:
//   ParameterReader reader(description);
//   settings.max = reader.Number("max", 5, 0, 1000);
//   if (auto status = reader.status(); !status) return base::Fail(status.error());
class ParameterReader {
 public:
  explicit ParameterReader(const model::SensorDescription& description)
      : description_(description) {}

  // The number of that name, `otherwise` if there is none. It must lie in [low, high].
  double Number(const std::string& name, double otherwise, double low, double high);

  // The same for a whole number.
  int Count(const std::string& name, int otherwise, int low, int high);

  // Yes or no; a number is yes unless it is 0.
  bool Flag(const std::string& name, bool otherwise);

  // Text; what is a number or a flag is refused.
  std::string Text(const std::string& name, const std::string& otherwise);

  // Two numbers, written as text: "0.5 0.5". Each must lie in [low, high].
  geometry::Vector2 Pair(const std::string& name, geometry::Vector2 otherwise, double low,
                         double high);

  // The same of three numbers: "1 0.5 0".
  geometry::Vector3 Triple(const std::string& name, geometry::Vector3 otherwise, double low,
                           double high);

  // Says that the parameters do not fit together.
  void Refuse(const std::string& why);

  const base::Status& status() const { return status_; }

 private:
  const model::SensorDescription& description_;
  base::Status status_;
};

}  // namespace gsv::sensing
