// The scenario of a recording's simulation: the attachment `scenario.yaml`, application/yaml
// (docs/formats/scenario.md).
#pragma once

#include <string_view>
#include <vector>

#include "gsv/scenario/scenario.h"
#include "gsv/simulation/simulation.h"

namespace gsv::recording {

inline constexpr std::string_view kScenarioAttachment = "scenario.yaml";
inline constexpr std::string_view kScenarioMediaType = "application/yaml";

// The scenario of a simulation from its state: sources of world and models, and the poses of robots
// at its start. A program that has the original scenario (the name of the world, options of
// behaviours) should attach that instead.
scenario::Scenario ScenarioOf(const simulation::Simulation& simulation);

// The edits by which a simulation that has not started came to stand as it does, but for those that
// ScenarioOf() holds: robots that were added, and where they stand. Empty once it has started.
std::vector<simulation::Edit> EditsBeforeStart(const simulation::Simulation& simulation);

}  // namespace gsv::recording
