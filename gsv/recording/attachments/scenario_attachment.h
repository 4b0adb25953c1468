// What a recording's simulation was told: the attachment `scenario.yaml`, application/yaml, in the
// form of docs/formats/scenario.md.
#pragma once

#include <string_view>

#include "gsv/scenario/scenario.h"
#include "gsv/simulation/simulation.h"

namespace gsv::recording {

inline constexpr std::string_view kScenarioAttachment = "scenario.yaml";
inline constexpr std::string_view kScenarioMediaType = "application/yaml";

// As a simulation stands: where the world and the models came from, and who stands where at its
// start. Whoever was told more (how the world was called, a behaviour's options) knows better.
scenario::Scenario ScenarioOf(const simulation::Simulation& simulation);

}  // namespace gsv::recording
