#include "gsv/gateway/api/factory_api.h"

#include <utility>

#include <nlohmann/json.hpp>

#include "gsv/gateway/api/scenario_json.h"
#include "gsv/gateway/api/status_json.h"
#include "gsv/presentation/pose_list.h"
#include "gsv/presentation/scene_json.h"

namespace gsv::gateway {
namespace {

using FactoryJson = nlohmann::ordered_json;

std::string Text(const FactoryJson& json) {
  return json.dump(-1, ' ', false, FactoryJson::error_handler_t::replace);
}

// What was understood and cannot be done is 422; else as everywhere.
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

// Those that the live stream would send as /gsv/poses.
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

Response RemoveRobot(simulation::Simulation& simulation, const std::string& robot) {
  const base::Status removed = simulation.RemoveRobot(robot);
  return removed ? JsonResponse(200, "{}") : ErrorResponse(removed.error());
}

Response RemoveObject(simulation::Simulation& simulation, const std::string& object) {
  const base::Status removed = simulation.RemoveObject(object);
  return removed ? JsonResponse(200, "{}") : ErrorResponse(removed.error());
}

Response PlaceBody(simulation::Simulation& simulation, const std::string& name,
                   const std::string& body) {
  const auto place = ParsePlace(body);
  if (!place) return Refusal(place.error());
  const base::Status placed = simulation.PlaceBody(name, place->world_from_body, place->on_ground);
  if (!placed) return Refusal({placed.error(), ""});
  return JsonResponse(200, "{}");
}

}  // namespace gsv::gateway
