// Writes the health of a simulation's robots, the output of their behaviours, and the expectations
// as JSON (docs/api.yaml).
#pragma once

#include <string>

#include "gsv/simulation/simulation.h"

namespace gsv::gateway {

// Returns the health of one robot, or of all robots if `robot` is empty. Reads the range sensors of
// robots that do not move, to report near obstacles.
std::string HealthJson(simulation::Simulation& simulation, const std::string& robot);
// Returns the lines that the programs of behaviours printed, for one robot, or for all robots if
// `robot` is empty.
std::string OutputJson(const simulation::Simulation& simulation, const std::string& robot);

}  // namespace gsv::gateway
