#include "gsv/gateway/api/api.h"

#include <utility>

#include "gsv/gateway/api/answers.h"
#include "gsv/gateway/api/command_json.h"
#include "gsv/gateway/api/health_json.h"
#include "gsv/gateway/api/joint_routes.h"
#include "gsv/gateway/api/simulation_routes.h"
#include "gsv/gateway/api/status_json.h"
#include "gsv/gateway/live/sensor_topics.h"
#include "gsv/presentation/scene_json.h"

namespace gsv::gateway {
namespace {

// Returns a response about the robot in the query ?robot=NAME, or about all robots.
template <typename Make>
Response OfRobot(const simulation::Simulation& simulation, const Request& request, Make make) {
  const auto found = request.target.query.find("robot");
  const std::string robot = found == request.target.query.end() ? "" : found->second;
  if (!robot.empty() && simulation.agent(robot) == nullptr) {
    return ErrorResponse(404, "there is no robot '" + robot + "'");
  }
  return JsonResponse(200, make(robot));
}

}  // namespace

Api::Api(std::shared_ptr<SimulationDirectory> directory, ModelStore::WriteGlb write_glb,
         RecordingSwitch* recordings, SimulationFactory* factory, bool has_replays,
         ListSensors list_sensors)
    : directory_(std::move(directory)),
      models_(std::move(write_glb)),
      recordings_(recordings),
      has_replays_(has_replays),
      list_sensors_(std::move(list_sensors)) {
  if (factory != nullptr) factory_.emplace(*factory, models_);
}

std::vector<Route> Api::Routes() {
  using enum Permission;
  using enum Pool;
  const auto of = [this](SimulationHandler handler) {
    return OfSimulation(directory_, std::move(handler));
  };
  const std::string simulation = "/api/simulations/{name}";
  std::vector<Route> routes{
      {"GET", "/api/server", kWatch, false, kReaders, [this](const Request&) { return Server(); },
       "List the capabilities of the server"},
      {"GET", "/api/simulations", kWatch, false, kReaders,
       [this](const Request&) { return List(); }, "List the simulations"},
      {"GET", "/api/models/{id}.glb", kWatch, false, kReaders,
       [this](const Request& request) { return Model(request); }, "Get a model as glTF"},
      {"GET", simulation, kWatch, false, kReaders, of([](const auto& of_name, const Request&) {
         return JsonResponse(200, StatusJson(of_name->status()));
       }),
       "Get the status of a simulation"},
      {"GET", simulation + "/health", kWatch, false, kReaders,
       of([](const auto& of_name, const Request& request) {
         return OfRobot(*of_name, request,
                        [&](const std::string& robot) { return HealthJson(*of_name, robot); });
       }),
       "Get what each robot does and why, and which expectations are met"},
      {"GET", simulation + "/output", kWatch, false, kReaders,
       of([](const auto& of_name, const Request& request) {
         return OfRobot(*of_name, request,
                        [&](const std::string& robot) { return OutputJson(*of_name, robot); });
       }),
       "Get the last lines that behaviours' programs printed"},
      {"GET", simulation + "/scene", kWatch, false, kReaders,
       of([this](const auto& of_name, const Request&) { return Scene(of_name); }),
       "Get the scene of a simulation, with bodies and their appearance"},
      {"GET", simulation + "/robots/{robot}/topics", kWatch, false, kReaders,
       of([this](const auto& of_name, const Request& request) {
         return Topics(of_name, request.Parameter("robot"));
       }),
       "List the topics of a robot's sensors"},
      {"GET", simulation + "/recording", kWatch, false, kReaders,
       of([this](const auto& of_name, const Request&) { return Recording(of_name); }),
       "Get whether the simulation is recorded, and to which file"},
      {"POST", simulation + "/recording", kControl, true, kCommanders,
       of([this](const auto& of_name, const Request& request) {
         return SwitchRecording(of_name, request.body);
       }),
       "Start or stop the recording"},
  };
  Append(routes, CommandRoutes(directory_));
  Append(routes, BodyRoutes(directory_));
  Append(routes, JointRoutes(directory_));
  if (factory_) Append(routes, factory_->Routes(directory_));
  return routes;
}

Response Api::Server() const {
  const auto text = [](bool value) { return value ? "true" : "false"; };
  return JsonResponse(200, std::string(R"({"creates":)") + text(factory_.has_value()) +
                               R"(,"records":)" + text(recordings_ != nullptr) +
                               R"(,"recordings":)" + text(has_replays_) + "}");
}

Response Api::List() const {
  std::vector<simulation::SimulationStatus> statuses;
  for (const SimulationPointer& simulation : directory_->List()) {
    statuses.push_back(simulation->status());
  }
  return JsonResponse(200, SimulationListJson(statuses));
}

Response Api::Model(const Request& request) {
  const std::string& id = request.Parameter("id");
  return ModelAnswer(request, id, models_.Glb(id));
}

Response Api::Scene(const SimulationPointer& simulation) {
  return JsonResponse(
      200, presentation::SceneJson(*simulation, models_.identify(), models_.identify_collisions()));
}

// Returns the topics of a robot's sensors, and makes the live stream advertise them. The simulation
// itself does not change.
Response Api::Topics(const SimulationPointer& simulation, const std::string& robot) const {
  if (simulation->snapshot()->layout->Find(robot) < 0) {
    return ErrorResponse(404, "there is no robot '" + robot + "'");
  }
  if (list_sensors_) list_sensors_(simulation, robot);
  return JsonResponse(200, TopicsJson(presentation::SensorTopicNames(*simulation, robot)));
}

Response Api::Recording(const SimulationPointer& simulation) const {
  if (recordings_ == nullptr) return ErrorResponse(404, "this server cannot record simulations");
  const std::string& name = simulation->specification().name;
  return JsonResponse(200, RecordingJson(recordings_->RecordingOf(name)));
}

Response Api::SwitchRecording(const SimulationPointer& simulation, const std::string& body) const {
  if (recordings_ == nullptr) return Recording(simulation);
  const base::Result<bool> record = ParseRecordingSwitch(body);
  if (!record) return ErrorResponse(record.error());
  const base::Status done = *record ? recordings_->Record(simulation)
                                    : recordings_->StopRecording(simulation->specification().name);
  return done ? Recording(simulation) : ErrorResponse(done.error());
}

}  // namespace gsv::gateway
