#include "gsv/sensing/parameters.h"

#include <cmath>
#include <sstream>

#include <fmt/format.h>

#include "gsv/sensing/asked_parameters.h"

namespace gsv::sensing {

void ParameterReader::Refuse(const std::string& why) {
  if (!status_) return;
  status_ = base::Fail(base::ErrorCode::kInvalidArgument, why,
                       fmt::format("{} {}", description_.type, description_.name));
}

double ParameterReader::Number(const std::string& name, double otherwise, double low, double high) {
  AskedParameters::Add(name);
  const auto it = description_.parameters.find(name);
  if (it == description_.parameters.end()) return otherwise;
  const double* value = std::get_if<double>(&it->second);
  if (value == nullptr) {
    Refuse(fmt::format("{} must be a number", name));
    return otherwise;
  }
  if (!(*value >= low && *value <= high)) {
    Refuse(fmt::format("{} is {}; it must lie between {} and {}", name, *value, low, high));
    return otherwise;
  }
  return *value;
}

bool ParameterReader::Flag(const std::string& name, bool otherwise) {
  AskedParameters::Add(name);
  const auto it = description_.parameters.find(name);
  if (it == description_.parameters.end()) return otherwise;
  if (const bool* flag = std::get_if<bool>(&it->second)) return *flag;
  if (const double* number = std::get_if<double>(&it->second)) return *number != 0;
  Refuse(fmt::format("{} must be true or false", name));
  return otherwise;
}

std::string ParameterReader::Text(const std::string& name, const std::string& otherwise) {
  AskedParameters::Add(name);
  const auto it = description_.parameters.find(name);
  if (it == description_.parameters.end()) return otherwise;
  if (const auto* text = std::get_if<std::string>(&it->second)) return *text;
  Refuse(fmt::format("{} must be text", name));
  return otherwise;
}

geometry::Vector2 ParameterReader::Pair(const std::string& name, geometry::Vector2 otherwise,
                                        double low, double high) {
  AskedParameters::Add(name);
  if (!description_.parameters.contains(name)) return otherwise;
  std::istringstream text(Text(name, ""));
  geometry::Vector2 pair;
  if (!(text >> pair.x >> pair.y) || !(text >> std::ws).eof()) {
    Refuse(fmt::format("{} must be two numbers, such as \"0.5 0.5\"", name));
    return otherwise;
  }
  for (const double value : {pair.x, pair.y}) {
    if (value >= low && value <= high) continue;
    Refuse(fmt::format("{} is {}; it must lie between {} and {}", name, value, low, high));
    return otherwise;
  }
  return pair;
}

geometry::Vector3 ParameterReader::Triple(const std::string& name, geometry::Vector3 otherwise,
                                          double low, double high) {
  AskedParameters::Add(name);
  if (!description_.parameters.contains(name)) return otherwise;
  std::istringstream text(Text(name, ""));
  geometry::Vector3 triple;
  if (!(text >> triple.x >> triple.y >> triple.z) || !(text >> std::ws).eof()) {
    Refuse(fmt::format("{} must be three numbers, such as \"1 0.5 0\"", name));
    return otherwise;
  }
  for (const double value : {triple.x, triple.y, triple.z}) {
    if (value >= low && value <= high) continue;
    Refuse(fmt::format("{} is {}; it must lie between {} and {}", name, value, low, high));
    return otherwise;
  }
  return triple;
}

int ParameterReader::Count(const std::string& name, int otherwise, int low, int high) {
  const double value = Number(name, otherwise, low, high);
  if (value != std::floor(value)) {
    Refuse(fmt::format("{} is {}; it must be a whole number", name, value));
    return otherwise;
  }
  return static_cast<int>(value);
}

}  // namespace gsv::sensing
