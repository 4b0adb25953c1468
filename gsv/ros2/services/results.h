// Makes Result messages of simulation_interfaces, and performs edits that require a paused
// simulation.
#pragma once

#include <functional>
#include <string>

#include "gsv/base/error.h"
#include "gsv/messages/simulation_interfaces.h"
#include "gsv/simulation/simulation.h"

namespace gsv::ros2 {

messages::simulation_interfaces::Result Succeeded();
// `code` is a constant of Result.
messages::simulation_interfaces::Result Failed(std::uint8_t code, std::string message);
// Converts an error to a result. kNotFound, kNotRunning and kEnded have their own codes. All other
// errors become RESULT_OPERATION_FAILED.
messages::simulation_interfaces::Result ResultOf(const base::Error& error);
messages::simulation_interfaces::Result ResultOf(const base::Status& status);

// Returns the current phase.
simulation::Phase PhaseOf(const simulation::Simulation& simulation);

// Performs an edit. A running simulation is paused for the edit, and then resumed.
base::Status EditWhilePaused(simulation::Simulation& simulation,
                             const std::function<base::Status()>& edit);

}  // namespace gsv::ros2
