// Formats the lines of `gsv ps` about the robots of one simulation.
#pragma once

#include <map>
#include <string>

#include "apps/gsv/serving/remote_simulations.h"

namespace gsv::app {

// Up to this number of robots, all are listed, ordered by name. Of more robots, only this number is
// listed: those with the most serious states.
inline constexpr std::size_t kMaxListed = 20;

// Returns one line per robot, with its health if the server reports it, else the detail of its
// state. If robots are left out, the last line counts them by state. With `lists_all`, all robots
// are listed. If they are many, those with the most serious states come first.
std::string RobotListing(const simulation::SimulationStatus& status,
                         const std::map<std::string, RemoteHealth>& healths, bool lists_all);

}  // namespace gsv::app
