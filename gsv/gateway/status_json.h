// A simulation's status as JSON, for the API (docs/api.yaml).
#pragma once

#include <string>
#include <vector>

#include "gsv/simulation/types.h"

namespace gsv::gateway {

// All of it.
std::string StatusJson(const simulation::SimulationStatus& status);
// An array with a line for each simulation.
std::string SimulationListJson(const std::vector<simulation::SimulationStatus>& simulations);

}  // namespace gsv::gateway
