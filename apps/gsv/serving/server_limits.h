// What a server that runs simulations holds at most; docs/limits.md lists the names.
#pragma once

#include <cstddef>
#include <string>

#include "apps/gsv/machine/trial_reading.h"
#include "gsv/gateway/gateway.h"
#include "gsv/services/simulation_host.h"
#include "gsv/simulation/limits.h"

namespace gsv::app {

struct ServerLimits {
  std::size_t simulations = services::kDefaultMaxSimulations;
  simulation::Limits simulation;
  TrialLimits reading;
  gateway::ServerLimits web;
  gateway::uploads::UploadLimits uploads;
  gateway::recordings::SessionLimits replays;
};

// Whether there is one of that name.
bool IsServerLimit(const std::string& name);
std::string ServerLimitNames();

// Sets one of them: "robots=500". kInvalidArgument: the number is not above zero, or larger than
// what a number of these can be raised to. IsServerLimit() of what stands before "=".
base::Status SetServerLimit(const std::string& text, ServerLimits& limits);

}  // namespace gsv::app
