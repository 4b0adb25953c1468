// Reads the keys of a scenario and of its parts (docs/formats/scenario.md), for files and for
// requests.
#pragma once

#include "gsv/scenario/scenario.h"
#include "gsv/scenario/yaml_mapping.h"

namespace gsv::scenario {

inline constexpr double kMaxCoordinate = 1e6;  // m
inline constexpr double kMaxDuration = 1e9;    // s

Scenario ReadScenarioKeys(const YAML::Node& node, const YamlPlace& place);

// Reads a robot or an avatar. An avatar has neither behaviour nor movement.
RobotEntry ReadRobotKeys(YamlMapping& mapping, bool is_avatar);

// Reads x, y, z and yaw. Returns nullopt if both x and y are absent.
std::optional<Place> ReadPlaceKeys(YamlMapping& mapping);

}  // namespace gsv::scenario
