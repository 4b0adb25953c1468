// The lines of `gsv ps` about the robots of one simulation.
#pragma once

#include <map>
#include <string>

#include "apps/gsv/serving/remote_simulations.h"

namespace gsv::app {

// The number of robots up to which all are listed, ordered by name. For a larger crowd, this number
// of robots with the worst states is listed.
inline constexpr std::size_t kMaxListed = 20;

// Returns one line per robot, with its health if the server reports it, else the detail of its
// state. If robots are left out, the last line counts them by state. With `lists_all`, all robots
// of a crowd are listed, the worst first.
std::string RobotListing(const simulation::SimulationStatus& status,
                         const std::map<std::string, RemoteHealth>& healths, bool lists_all);

}  // namespace gsv::app
