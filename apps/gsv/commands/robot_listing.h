// Formats the lines of `gsv ps` about the robots of one simulation.
#pragma once

#include <map>
#include <string>

#include "apps/gsv/serving/remote_simulations.h"

namespace gsv::app {

// The maximum number of listed robots. If there are more robots, only those with the most serious
// states are listed. Otherwise, all robots are listed, ordered by name.
inline constexpr std::size_t kMaxListed = 20;

// Returns one line per robot, with the robot's health if the server reports it, else with the
// detail of the robot's state. If robots are left out, the last line counts these robots by state.
// With `lists_all`, all robots are listed. If there are more than kMaxListed, those with the most
// serious states come first.
std::string RobotListing(const simulation::SimulationStatus& status,
                         const std::map<std::string, RemoteHealth>& healths, bool lists_all);

}  // namespace gsv::app
