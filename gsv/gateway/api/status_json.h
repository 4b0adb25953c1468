// A simulation's status as JSON, for the API (docs/api.yaml).
#pragma once

#include <string>
#include <vector>

#include "gsv/gateway/program/ports.h"
#include "gsv/gateway/replay/replay_clock.h"
#include "gsv/simulation/types.h"

namespace gsv::gateway {

// Returns the complete status of a simulation or of a replay. A replay's status has the member
// "replay" (see ReplayJson()), but not the health of robots.
std::string StatusJson(const simulation::SimulationStatus& status);
std::string StatusJson(const simulation::SimulationStatus& status, const ReplayClock& replay);
// Returns {"start_s", "end_s", "time_s", "speed", "loop"}.
std::string ReplayJson(const ReplayClock& clock);
// Returns {"recording", "path", "messages", "dropped_messages", "size_bytes"}.
std::string RecordingJson(const RecordingSwitch::State& state);
// Returns {"topics"}, a list of names.
std::string TopicsJson(const std::vector<std::string>& topics);
// Returns an array with an object per simulation.
std::string SimulationListJson(const std::vector<simulation::SimulationStatus>& simulations);

}  // namespace gsv::gateway
