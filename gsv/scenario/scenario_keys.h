// The keys of a scenario and of its parts, as docs/formats/scenario.md lists them: the one place
// that reads them, from files and from requests.
#pragma once

#include "gsv/scenario/scenario.h"
#include "gsv/scenario/yaml_mapping.h"

namespace gsv::scenario {

inline constexpr double kMaxCoordinate = 1e6;  // m
inline constexpr double kMaxDuration = 1e9;    // s

Scenario ReadScenarioKeys(const YAML::Node& node, const YamlPlace& place);

// A robot, or an avatar, which has neither behaviour nor movement.
RobotEntry ReadRobotKeys(YamlMapping& mapping, bool is_avatar);

// x, y, z and yaw. Nothing where there is neither x nor y.
std::optional<Place> ReadPlaceKeys(YamlMapping& mapping);

}  // namespace gsv::scenario
