// Attaches the scenario of the recorded simulation as `scenario.yaml`, application/yaml
// (docs/formats/scenario.md).
#pragma once

#include <string_view>
#include <vector>

#include "gsv/scenario/scenario.h"
#include "gsv/simulation/simulation.h"

namespace gsv::recording {

inline constexpr std::string_view kScenarioAttachment = "scenario.yaml";
inline constexpr std::string_view kScenarioMediaType = "application/yaml";

// Derives the scenario of a simulation from its state: the sources of the world and the models, and
// the poses of robots at the start. A program that has the original scenario, with the name of the
// world and the options of behaviours, should attach the original instead.
scenario::Scenario ScenarioOf(const simulation::Simulation& simulation);

// Returns the edits that turn ScenarioOf() into the present state of a simulation that has not
// started: added robots, and their poses. Empty once the simulation has started.
std::vector<simulation::Edit> EditsBeforeStart(const simulation::Simulation& simulation);

}  // namespace gsv::recording
