// The routes of one simulation, /api/simulations/{name}/…, that need no other object.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "gsv/gateway/http/route.h"
#include "gsv/gateway/program/ports.h"

namespace gsv::gateway {

using SimulationHandler =
    std::function<Response(const std::shared_ptr<simulation::Simulation>&, const Request&)>;

// Calls `handler` with the simulation {name}; answers 404 if there is no such simulation.
Route::Handler OfSimulation(std::shared_ptr<SimulationDirectory> directory,
                            SimulationHandler handler);

// The routes of commands: POST /api/simulations/{name}/COMMAND for each command in
// simulation/commands/command_table.h, also under its former names. The body has the command's
// arguments; the response is the simulation's status. GET …/commands describes all commands.
std::vector<Route> CommandRoutes(const std::shared_ptr<SimulationDirectory>& directory);

// Routes that place and remove the bodies of a simulation, and drive its avatars.
std::vector<Route> BodyRoutes(const std::shared_ptr<SimulationDirectory>& directory);

}  // namespace gsv::gateway
