// Reads scenarios and their parts from requests: JSON objects with the keys of
// docs/formats/scenario.md.
//
// Units   metres, radians, seconds.
// Input   an untrusted JSON object of at most kMaxScenarioBytes.
// Errors  each problem names the field: "robots[1].x".
#pragma once

#include <string>

#include "gsv/scenario/scenario.h"

namespace gsv::scenario {

Scenario ParseScenarioJson(const std::string& json, base::Problems& problems);

// Reads {name, model, x, y, z, yaw, behaviour, behaviour_constraint, movement, drive}. An avatar
// has only the keys up to yaw.
RobotEntry ParseRobotJson(const std::string& json, bool is_avatar, base::Problems& problems);

// Reads {x, y, z, yaw}, where x and y are required.
Place ParsePlaceJson(const std::string& json, base::Problems& problems);

}  // namespace gsv::scenario
