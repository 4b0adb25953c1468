// The limits of a server that runs simulations. docs/limits.md lists the names.
#pragma once

#include <cstddef>
#include <string>

#include "apps/gsv/machine/trial_reading.h"
#include "gsv/gateway/gateway.h"
#include "gsv/services/simulation_host.h"
#include "gsv/simulation/limits.h"

namespace gsv::app {

struct ServerLimits {
  std::size_t simulations = services::kDefaultMaxSimulations;  // maximum number of simulations
  simulation::Limits simulation;                               // limits of each simulation
  TrialLimits reading;                         // limits for reading a world that is not built in
  gateway::ServerLimits web;                   // limits of HTTP and WebSocket connections
  gateway::uploads::UploadLimits uploads;      // limits of uploaded files
  gateway::recordings::SessionLimits replays;  // limits of the sessions that replay recordings
};

// Whether there is a limit with that name.
bool IsServerLimit(const std::string& name);
// Returns the names of all limits, separated by commas.
std::string ServerLimitNames();

// Sets a limit from a text such as "robots=500", for which IsServerLimit("robots") must return
// true. Returns kInvalidArgument if the number is not positive, or larger than the maximum of that
// limit.
base::Status SetServerLimit(const std::string& text, ServerLimits& limits);

}  // namespace gsv::app
