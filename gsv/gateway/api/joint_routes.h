// Routes for the joints of a simulation's bodies: their state, and commands to them.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "gsv/gateway/api/simulation_routes.h"

namespace gsv::gateway {

// Returns a sentence if viewers may not command this robot because its behaviour controls it.
// Returns nullopt for avatars, for robots without a behaviour or with a finished one, and for other
// bodies.
std::optional<std::string> ControlledByBehaviour(const simulation::Simulation& simulation,
                                                 const std::string& robot);

// GET  …/bodies/{body}/joints          the joints that can take commands, with limits and state
// POST …/bodies/{body}/joints/{joint}  commands a joint: {"position": v}, {"velocity": v} or
//                                      {"effort": v}
std::vector<Route> JointRoutes(const std::shared_ptr<SimulationDirectory>& directory);

}  // namespace gsv::gateway
