// Scenarios and their parts as requests carry them: JSON objects with the keys of
// docs/formats/scenario.md.
//
// Units   metres, radians, seconds.
// Input   a JSON object, of whatever content, of kMaxScenarioBytes bytes at most.
// Errors  each problem names the field: "robots[1].x".
#pragma once

#include <string>

#include "gsv/scenario/scenario.h"

namespace gsv::scenario {

Scenario ParseScenarioJson(const std::string& json, base::Problems& problems);

// Of {name, model, x, y, z, yaw, behaviour, behaviour_constraint, movement}.
RobotEntry ParseRobotJson(const std::string& json, bool is_avatar, base::Problems& problems);

// Of {x, y, z, yaw}; x and y are needed.
Place ParsePlaceJson(const std::string& json, base::Problems& problems);

}  // namespace gsv::scenario
