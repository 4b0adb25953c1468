#include "gsv/reality/option_check.h"

#include <algorithm>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "gsv/base/spelling.h"
#include "gsv/reality/scan_placing.h"
#include "gsv/sensing/asked_parameters.h"
#include "gsv/sensing/devices/built_in.h"
#include "gsv/sensing/devices/odometry_drift.h"
#include "gsv/sensing/registry.h"

namespace gsv::reality {
namespace {

// Returns the sensor types of the log's devices.
std::vector<std::string> TypesOf(const Log& log) {
  std::vector<std::string> types;
  if (HasOdometry(log)) types.emplace_back("odometry");
  if (HasScans(log)) types.push_back(ScannerOf(log));
  if (!log.radio.empty()) types.emplace_back("ranging");
  return types;
}

// Returns the names of all parameters of a device of this type, with these options.
std::vector<std::string> ParametersOf(const std::string& type, const CompareOptions& options) {
  sensing::SensorRegistry registry;
  sensing::AddBuiltInSensors(registry);
  model::SensorDescription description;
  description.name = description.type = type;
  description.parameters = options.parameters;
  // A sonar is created with a cone beam, because it then has all parameters of sonars.
  if (type == "sonar") description.parameters["beam"] = std::string("cone");
  const std::string preset = PresetOf(type, options);
  if (!preset.empty()) description.parameters["preset"] = preset;
  const sensing::AskedParameters asked;
  // Creating a device lists its parameters; errors are reported later, where the device is used.
  (void)registry.Find(type)->create(description);
  if (type == "odometry") {
    sensing::ParameterReader reader(description);
    (void)sensing::ReadOdometryDrift(reader);
  }
  return {asked.names().begin(), asked.names().end()};
}

base::Status CheckNames(const std::vector<std::string>& types, const CompareOptions& options) {
  std::vector<std::string> known;
  for (const std::string& type : types) {
    const auto names = ParametersOf(type, options);
    known.insert(known.end(), names.begin(), names.end());
  }
  for (const auto& [name, value] : options.parameters) {
    if (name == "preset" || std::find(known.begin(), known.end(), name) != known.end()) continue;
    return base::Fail(base::ErrorCode::kInvalidArgument,
                      fmt::format("the log's devices ({}) have no parameter \"{}\"{}",
                                  fmt::join(types, ", "), name, base::DidYouMean(name, known)));
  }
  return {};
}

}  // namespace

bool HasOdometry(const Log& log) {
  return log.truth_has_yaw && log.truth.size() > 1 &&
         (!log.odometry.empty() || !log.wheels.empty() || !log.commands.empty());
}

bool HasScans(const Log& log) { return !log.scans.empty() && log.scans.front().base; }

base::Status CheckOptions(const Log& log, const CompareOptions& options) {
  const std::vector<std::string> types = TypesOf(log);
  if (types.empty()) return {};
  bool has_preset = options.preset.empty();
  for (const std::string& type : types) has_preset = has_preset || !PresetOf(type, options).empty();
  if (!has_preset) {
    return base::Fail(
        base::ErrorCode::kInvalidArgument,
        fmt::format("there is no preset \"{}\" of the log's devices ({}); docs/sensors.md "
                    "lists the presets",
                    options.preset, fmt::join(types, ", ")));
  }
  return CheckNames(types, options);
}

}  // namespace gsv::reality
