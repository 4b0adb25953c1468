#include "gsv/gateway/api/factory_api.h"

#include <utility>

#include <nlohmann/json.hpp>

#include "gsv/gateway/api/scenario_json.h"
#include "gsv/gateway/api/simulation_routes.h"
#include "gsv/gateway/api/status_json.h"
#include "gsv/presentation/pose_list.h"
#include "gsv/presentation/scene_json.h"

namespace gsv::gateway {
namespace {

using FactoryJson = nlohmann::ordered_json;

std::string Text(const FactoryJson& json) {
  return json.dump(-1, ' ', false, FactoryJson::error_handler_t::replace);
}

// Returns the poses in the form in which the live stream sends /gsv/poses.
FactoryJson PosesJson(const world::Snapshot& snapshot) {
  FactoryJson numbers = FactoryJson::array();
  for (const geometry::Pose& pose :
       presentation::PosesOf(snapshot, presentation::PoseListOf(*snapshot.layout))) {
    const auto& [p, q] = pose;
    for (const double number : {p.x, p.y, p.z, q.x, q.y, q.z, q.w}) numbers.push_back(number);
  }
  return numbers;
}

}  // namespace

std::vector<Route> FactoryApi::Routes(const std::shared_ptr<SimulationDirectory>& directory) {
  using enum Permission;
  using enum Pool;
  const auto of = [&](Response (FactoryApi::*change)(const std::shared_ptr<simulation::Simulation>&,
                                                     const std::string& body) const) {
    return OfSimulation(directory, [this, change](const auto& simulation, const Request& request) {
      return (this->*change)(simulation, request.body);
    });
  };
  return {
      {"GET", "/api/worlds", kWatch, false, kReaders, [this](const Request&) { return Worlds(); },
       "List the built-in worlds"},
      {"GET", "/api/models", kWatch, false, kReaders, [this](const Request&) { return Models(); },
       "List the models for robots, built-in and on the model path"},
      {"GET", "/api/behaviours", kWatch, false, kReaders,
       [this](const Request& request) { return Behaviours(request.target); },
       "List the behaviours that the broker offers"},
      {"GET", "/api/ros2", kWatch, false, kReaders, [this](const Request&) { return Ros2(); },
       "Get whether new simulations can be published to ROS 2 nodes"},
      {"POST", "/api/preview", kControl, false, kReaders,
       [this](const Request& request) { return Preview(request.body); },
       "Get the scene of a scenario at its start, without creating a simulation"},
      {"POST", "/api/simulations", kControl, false, kCommanders,
       [this](const Request& request) { return Create(request.body); }, "Create a simulation"},
      {"DELETE", "/api/simulations/{name}", kControl, true, kCommanders,
       OfSimulation(directory,
                    [this](const auto&, const Request& request) {
                      return Destroy(request.Parameter("name"));
                    }),
       "Stop and remove a simulation; its recording is closed"},
      {"POST", "/api/simulations/{name}/robots", kControl, true, kCommanders,
       of(&FactoryApi::AddRobot), "Add a robot or an avatar"},
      {"POST", "/api/simulations/{name}/objects", kControl, true, kCommanders,
       of(&FactoryApi::AddObject), "Add an object to the world"},
      {"GET", "/api/simulations/{name}/world", kWatch, false, kReaders,
       OfSimulation(directory,
                    [this](const auto& simulation, const Request& request) {
                      return SaveWorld(simulation, request.target);
                    }),
       "Get the current world as SDFormat, and its scenario"},
  };
}

Response FactoryApi::Worlds() const {
  FactoryJson worlds = FactoryJson::array();
  for (const std::string& name : factory_.Worlds()) worlds.push_back({{"name", name}});
  return JsonResponse(200, Text({{"worlds", std::move(worlds)}}));
}

Response FactoryApi::Models() const {
  FactoryJson models = FactoryJson::array();
  for (const SimulationFactory::ModelLine& model : factory_.Models()) {
    models.push_back({{"name", model.name}, {"is_avatar", model.is_avatar}});
  }
  FactoryJson objects = FactoryJson::array();
  for (const std::string& name : factory_.Objects()) objects.push_back({{"name", name}});
  return JsonResponse(200, Text({{"models", std::move(models)}, {"objects", std::move(objects)}}));
}

Response FactoryApi::Behaviours(const Target& target) const {
  const auto constraint = target.query.find("constraint");
  const auto found =
      factory_.FindBehaviours(constraint == target.query.end() ? "" : constraint->second);
  if (!found) return ErrorResponse(found.error());
  FactoryJson offers = FactoryJson::array();
  for (const SimulationFactory::BehaviourLine& offer : found->offers) {
    offers.push_back({{"name", offer.name},
                      {"description", offer.description},
                      {"host", offer.host},
                      {"pid", offer.pid},
                      {"time_managed", offer.time_managed}});
  }
  return JsonResponse(200, Text({{"behaviours", std::move(offers)},
                                 {"broker", found->broker},
                                 {"start_command", found->start_command}}));
}

Response FactoryApi::Ros2() const {
  const SimulationFactory::Ros2Support support = factory_.Ros2();
  return JsonResponse(200, Text({{"available", support.is_available},
                                 {"reason", support.reason},
                                 {"reach", support.reach},
                                 {"published", support.published}}));
}

Response FactoryApi::Preview(const std::string& body) const {
  const auto request = ParseSimulationRequest(body);
  if (!request) return Refusal(request.error());
  const auto preview = factory_.Show(*request);
  if (!preview) return Refusal(preview.error());
  const std::string scene = presentation::SceneJson(*preview->simulation, models_.identify(),
                                                    models_.identify_collisions());
  return JsonResponse(200, R"({"scene":)" + scene + R"(,"poses":)" +
                               Text(PosesJson(*preview->simulation->snapshot())) +
                               R"(,"warnings":)" + Text(preview->warnings) + "}");
}

Response FactoryApi::Create(const std::string& body) const {
  const auto request = ParseSimulationRequest(body);
  if (!request) return Refusal(request.error());
  const auto created = factory_.Create(*request);
  if (!created) return Refusal(created.error());
  return JsonResponse(201, StatusJson((*created)->status()));
}

Response FactoryApi::Destroy(const std::string& simulation) const {
  const base::Status destroyed = factory_.Destroy(simulation);
  return destroyed ? JsonResponse(200, "{}") : ErrorResponse(destroyed.error());
}

Response FactoryApi::AddRobot(const std::shared_ptr<simulation::Simulation>& simulation,
                              const std::string& body) const {
  const auto robot = ParseRobotRequest(body);
  if (!robot) return Refusal(robot.error());
  const auto name = factory_.AddRobot(simulation, robot->robot, robot->is_avatar);
  if (!name) return Refusal(name.error());
  return JsonResponse(201, Text({{"name", *name}}));
}

Response FactoryApi::AddObject(const std::shared_ptr<simulation::Simulation>& simulation,
                               const std::string& body) const {
  const auto object = ParseObjectRequest(body);
  if (!object) return Refusal(object.error());
  const auto name = factory_.AddObject(simulation, *object);
  if (!name) return Refusal(name.error());
  return JsonResponse(201, Text({{"name", *name}}));
}

Response FactoryApi::SaveWorld(const std::shared_ptr<simulation::Simulation>& simulation,
                               const Target& target) const {
  const auto file = target.query.find("file");
  const auto saved = factory_.SaveWorld(
      *simulation, file == target.query.end() ? simulation->status().name + ".sdf" : file->second);
  if (!saved) return ErrorResponse(saved.error());
  return JsonResponse(
      200,
      Text({{"sdf", saved->sdf}, {"scenario", saved->scenario}, {"warnings", saved->warnings}}));
}

Response Refusal(const FieldError& wrong) {
  const base::ErrorCode code = wrong.error.code;
  const bool is_of_no_use = code == base::ErrorCode::kBadModel ||
                            code == base::ErrorCode::kBehaviour ||
                            code == base::ErrorCode::kNotFound;
  Response response =
      is_of_no_use ? ErrorResponse(422, wrong.error.Sentence()) : ErrorResponse(wrong.error);
  response.body = SharedBytes(Text({{"error", wrong.error.Sentence()}, {"field", wrong.field}}));
  return response;
}

}  // namespace gsv::gateway
