// Reads the parameters of a sensor and checks their types and ranges.
#pragma once

#include <limits>
#include <string>

#include "gsv/base/error.h"
#include "gsv/geometry/vector3.h"
#include "gsv/model/sensor_description.h"

namespace gsv::sensing {

// Reads one sensor's parameters and keeps the first error. So the caller checks for errors only
// once, at the end:
//   ParameterReader reader(description);
//   settings.max = reader.Number("max", 5, 0, 1000);
//   if (auto status = reader.status(); !status) return base::Fail(status.error());
class ParameterReader {
 public:
  explicit ParameterReader(const model::SensorDescription& description)
      : description_(description) {}

  // Returns the number with that name, or `otherwise` if it is absent. A number must be in [low,
  // high].
  double Number(const std::string& name, double otherwise, double low, double high);

  // Returns the integer with that name, or `otherwise` if it is absent. An integer must be in [low,
  // high].
  int Count(const std::string& name, int otherwise, int low, int high);

  // Returns a flag. A number is true unless it is 0.
  bool Flag(const std::string& name, bool otherwise);

  // Returns a text. A number or a flag is an error.
  std::string Text(const std::string& name, const std::string& otherwise);

  // Returns two numbers, written as text: "0.5 0.5". Each must be in [low, high].
  geometry::Vector2 Pair(const std::string& name, geometry::Vector2 otherwise, double low,
                         double high);

  // Returns three numbers, written as text: "1 0.5 0". Each must be in [low, high].
  geometry::Vector3 Triple(const std::string& name, geometry::Vector3 otherwise, double low,
                           double high);

  // Records an error, for example that two parameters contradict each other.
  void Refuse(const std::string& why);

  const base::Status& status() const { return status_; }

 private:
  const model::SensorDescription& description_;
  base::Status status_;  // the first error, or success
};

}  // namespace gsv::sensing
