#include "gsv/gateway/api/simulation_routes.h"

#include <string>
#include <utility>

#include "gsv/gateway/api/command_json.h"
#include "gsv/gateway/api/command_timeouts.h"
#include "gsv/gateway/api/factory_api.h"
#include "gsv/gateway/api/joint_routes.h"
#include "gsv/gateway/api/scenario_json.h"
#include "gsv/gateway/api/status_json.h"
#include "gsv/simulation/commands/command_table.h"

namespace gsv::gateway {
namespace {

using simulation::Simulation;
using SimulationPointer = std::shared_ptr<Simulation>;

Response Done(const base::Status& done) {
  return done ? JsonResponse(200, "{}") : ErrorResponse(done.error());
}

SimulationHandler Applying(const simulation::Command& command) {
  return [&command](const SimulationPointer& simulation, const Request& request) {
    const auto arguments = ParseArguments(command, request.body);
    if (!arguments) return ErrorResponse(arguments.error());
    const base::Status done = command.apply(*simulation, *arguments);
    if (!done) return ErrorResponse(done.error());
    return JsonResponse(200, StatusJson(simulation->status()));
  };
}

// Stops a robot that a user drives. Does nothing if a behaviour controls the robot now.
void StopRobot(const std::weak_ptr<Simulation>& weak, const std::string& robot) {
  const SimulationPointer simulation = weak.lock();
  const auto agent = simulation ? simulation->agent(robot) : nullptr;
  if (agent && !ControlledByBehaviour(*simulation, robot)) (void)agent->Command({});
}

// Drives a robot. A robot with a behaviour accepts only the commands of its behaviour.
Response Drive(CommandTimeouts& timeouts, const SimulationPointer& simulation,
               const Request& request) {
  const std::string& robot = request.Parameter("robot");
  const std::shared_ptr<simulation::Agent> agent = simulation->agent(robot);
  if (!agent) return ErrorResponse(404, "there is no robot '" + robot + "'");
  const std::shared_ptr<const world::Snapshot> snapshot = simulation->snapshot();
  const int index = snapshot->layout->Find(robot);
  if (index < 0 || !snapshot->layout->bodies[index].is_robot()) {
    return ErrorResponse(409, "'" + robot + "' has no drive");
  }
  if (const auto reason = ControlledByBehaviour(*simulation, robot)) {
    return ErrorResponse(409, *reason);
  }
  const base::Result<TimedDriveCommand> timed = ParseDriveCommand(request.body);
  if (!timed) return ErrorResponse(timed.error());
  const std::string key = simulation->specification().name + '\n' + robot;
  timeouts.Cancel(key);
  const base::Status done = agent->Command(timed->command);
  if (done && timed->timeout) {
    timeouts.Set(key,
                 std::chrono::duration_cast<std::chrono::nanoseconds>(
                     std::chrono::duration<double>(*timed->timeout)),
                 [weak = std::weak_ptr(simulation), robot] { StopRobot(weak, robot); });
  }
  return Done(done);
}

Response RemoveRobot(const SimulationPointer& simulation, const Request& request) {
  return Done(simulation->RemoveRobot(request.Parameter("robot")));
}

Response RemoveObject(const SimulationPointer& simulation, const Request& request) {
  return Done(simulation->RemoveObject(request.Parameter("object")));
}

Response PlaceBody(const SimulationPointer& simulation, const Request& request) {
  const auto place = ParsePlace(request.body);
  if (!place) return Refusal(place.error());
  const base::Status placed =
      simulation->PlaceBody(request.Parameter("body"), place->world_from_body, place->on_ground);
  return placed ? JsonResponse(200, "{}") : Refusal({placed.error(), ""});
}

}  // namespace

Route::Handler OfSimulation(std::shared_ptr<SimulationDirectory> directory,
                            SimulationHandler handler) {
  return [directory = std::move(directory), handler = std::move(handler)](const Request& request) {
    const std::string& name = request.Parameter("name");
    const SimulationPointer simulation = directory->Find(name);
    if (!simulation) return ErrorResponse(404, "there is no simulation '" + name + "'");
    return handler(simulation, request);
  };
}

std::vector<Route> CommandRoutes(const std::shared_ptr<SimulationDirectory>& directory) {
  const std::string simulation = "/api/simulations/{name}/";
  std::vector<Route> routes{
      {"GET", simulation + "commands", Permission::kWatch, false, Pool::kReaders,
       OfSimulation(directory, [](const SimulationPointer&,
                                  const Request&) { return JsonResponse(200, CommandsJson()); }),
       "List the commands of a simulation"}};
  for (const simulation::Command& command : simulation::CommandsWithFormerNames()) {
    routes.push_back({"POST", simulation + std::string(command.name), Permission::kControl, true,
                      Pool::kCommanders, OfSimulation(directory, Applying(command)),
                      std::string(command.summary)});
  }
  return routes;
}

std::vector<Route> BodyRoutes(const std::shared_ptr<SimulationDirectory>& directory) {
  using enum Permission;
  using enum Pool;
  const std::string simulation = "/api/simulations/{name}";
  const auto timeouts = std::make_shared<CommandTimeouts>();
  return {
      {"DELETE", simulation + "/robots/{robot}", kControl, true, kCommanders,
       OfSimulation(directory, &RemoveRobot), "Remove a robot or an avatar"},
      {"POST", simulation + "/robots/{robot}/drive", kControl, true, kCommanders,
       OfSimulation(directory,
                    [timeouts](const SimulationPointer& of_name, const Request& request) {
                      return Drive(*timeouts, of_name, request);
                    }),
       "Set the velocity of an avatar, or of a robot without a behaviour"},
      {"DELETE", simulation + "/objects/{object}", kControl, true, kCommanders,
       OfSimulation(directory, &RemoveObject), "Remove an object"},
      {"POST", simulation + "/bodies/{body}/place", kControl, true, kCommanders,
       OfSimulation(directory, &PlaceBody),
       "Set the pose of a robot, an avatar or an object, and stop its motion"},
  };
}

}  // namespace gsv::gateway
