// Parses the bodies of requests with commands, and describes the commands as JSON. An empty body
// counts as {}.
//
// Errors  kInvalidArgument with a sentence that names the field.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "gsv/base/error.h"
#include "gsv/simulation/commands/command.h"
#include "gsv/world/state.h"

namespace gsv::gateway {

// Parses {"PARAMETER": value, …}. The body of a command without parameters is ignored.
base::Result<simulation::Arguments> ParseArguments(const simulation::Command& command,
                                                   std::string_view body);

// Describes all commands: an array of {"name", "summary", "parameters": [{"name", "type", "unit",
// "summary", "required", "minimum", "maximum", "default", "default_meaning"}]}. Keys without a
// value are left out.
std::string CommandsJson();

// The maximum of the timeout of a drive command, in seconds of wall-clock time.
inline constexpr double kMaxDriveTimeout = 60;
// A drive command that ends after a time.
struct TimedDriveCommand {
  world::DriveCommand command;
  // s of wall-clock time until the robot stops. nullopt: it does not stop by itself.
  std::optional<double> timeout;
};
// Parses {"linear_m_s": v, "lateral_m_s": v, "angular_rad_s": w, "timeout_s": t}. A missing
// velocity is 0. Without timeout_s there is no timeout.
base::Result<TimedDriveCommand> ParseDriveCommand(std::string_view body);

// Parses {"position": v}, {"velocity": v} or {"effort": v}: exactly one of these keys, in SI units.
base::Result<world::JointCommand> ParseJointCommand(std::string_view body);

// Parses {"record": true or false}.
base::Result<bool> ParseRecordingSwitch(std::string_view body);

}  // namespace gsv::gateway
