// The bodies of requests that command something. An empty body counts as {}.
//
// Errors  kInvalidArgument with a sentence that names the field.
#pragma once

#include <cstdint>
#include <string_view>

#include "gsv/base/error.h"
#include "gsv/world/state.h"

namespace gsv::gateway {

// {"count": N}, N from 1 to a thousand million; 1 when it is absent.
base::Result<std::int64_t> ParseStepCount(std::string_view body);

// {"factor": F}, simulated seconds a wall second; what it may be, the simulation says.
base::Result<double> ParseFactor(std::string_view body);

// {"linear_m_s": v, "lateral_m_s": v, "angular_rad_s": w}; what is absent is 0.
base::Result<world::DriveCommand> ParseDriveCommand(std::string_view body);

// {"record": true or false}.
base::Result<bool> ParseRecordingSwitch(std::string_view body);

}  // namespace gsv::gateway
