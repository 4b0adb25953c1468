// Commands as JSON: bodies of requests, and the description of commands. An empty body counts as
// {}.
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

// {"PARAMETER": value, …}. The body of a command without parameters is ignored.
base::Result<simulation::Arguments> ParseArguments(const simulation::Command& command,
                                                   std::string_view body);

// All commands of the table: an array of {"name", "summary", "parameters": [{"name", "type",
// "unit", "summary", "required", "minimum", "maximum", "default", "default_meaning"}]}. Keys
// without a value are left out.
std::string CommandsJson();

// The longest time in wall-clock seconds after which a robot stops by itself.
inline constexpr double kMaxDriveTimeout = 60;
struct TimedDriveCommand {
  world::DriveCommand command;
  std::optional<double> timeout;  // s; nothing: the command lasts
};
// Parses {"linear_m_s": v, "lateral_m_s": v, "angular_rad_s": w, "timeout_s": t}. A missing value
// is 0, and a missing timeout is none.
base::Result<TimedDriveCommand> ParseDriveCommand(std::string_view body);

// Parses {"position": v}, {"velocity": v} or {"effort": v}: exactly one of them, in SI units.
base::Result<world::JointCommand> ParseJointCommand(std::string_view body);

// Parses {"record": true or false}.
base::Result<bool> ParseRecordingSwitch(std::string_view body);

}  // namespace gsv::gateway
