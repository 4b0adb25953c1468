#include "gsv/gateway/api/api.h"

#include <cmath>
#include <optional>
#include <utility>

#include "gsv/gateway/api/answers.h"
#include "gsv/gateway/api/command_json.h"
#include "gsv/gateway/api/status_json.h"
#include "gsv/gateway/live/sensor_topics.h"
#include "gsv/gateway/live/simulation_commands.h"
#include "gsv/presentation/scene_json.h"

namespace gsv::gateway {
namespace {

using simulation::Simulation;

base::Status Obey(Simulation& simulation, const SimulationCommand& command,
                  const std::string& body) {
  if (!command.takes_count) return command.run(simulation, 0);
  const base::Result<std::int64_t> count = ParseStepCount(body);
  if (!count) return base::Fail(count.error());
  return command.run(simulation, *count);
}

base::Status SetFactor(Simulation& simulation, const std::string& body) {
  const base::Result<double> factor = ParseFactor(body);
  if (!factor) return base::Fail(factor.error());
  return simulation.SetFactor(*factor);
}

Response StatusOf(const Simulation& simulation) {
  return JsonResponse(200, StatusJson(simulation.status()));
}

// Steers an avatar. Robots with a behaviour are steered by that alone.
Response Drive(const Simulation& simulation, const std::string& robot, const std::string& body) {
  const std::shared_ptr<simulation::Agent> agent = simulation.agent(robot);
  if (!agent) return ErrorResponse(404, "there is no robot '" + robot + "'");
  const std::shared_ptr<const world::Snapshot> snapshot = simulation.snapshot();
  const int index = snapshot->layout->Find(robot);
  if (index < 0 || !snapshot->layout->bodies[index].is_avatar()) {
    return ErrorResponse(409, "'" + robot + "' is not an avatar: only its behaviour steers it");
  }
  const base::Result<world::DriveCommand> command = ParseDriveCommand(body);
  if (!command) return ErrorResponse(command.error());
  if (const base::Status given = agent->Command(*command); !given) {
    return ErrorResponse(given.error());
  }
  return JsonResponse(200, "{}");
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

Response Api::Handle(const Request& request) {
  const std::vector<std::string>& path = request.target.segments;
  if (path.size() < 2) return NoSuchAddress();
  const bool is_get = request.method == "GET";
  if (path[1] == "models" && path.size() > 2) {
    return ModelAnswer(request, [this](const std::string& id) { return models_.Glb(id); });
  }
  if (path[1] == "simulations" && path.size() > 2) return OfSimulation(request);
  if (path.size() > 2) return NoSuchAddress();
  if (path[1] == "simulations" && is_get) return List();
  if (path[1] == "server") return is_get ? Server() : MethodNotAllowed("GET");
  return OfFactory(request);
}

Response Api::Server() const {
  const auto text = [](bool value) { return value ? "true" : "false"; };
  return JsonResponse(200, std::string(R"({"creates":)") + text(factory_.has_value()) +
                               R"(,"records":)" + text(recordings_ != nullptr) +
                               R"(,"recordings":)" + text(has_replays_) + "}");
}

Response Api::OfFactory(const Request& request) const {
  const std::string& what = request.target.segments[1];
  const bool is_post = request.method == "POST";
  if (!factory_) {
    if (what == "simulations") return MethodNotAllowed("GET");
    return NoSuchAddress();
  }
  if (what == "simulations") {
    return is_post ? factory_->Create(request.body) : MethodNotAllowed("GET, POST");
  }
  if (what == "preview") {
    return is_post ? factory_->Preview(request.body) : MethodNotAllowed("POST");
  }
  const bool is_list = what == "worlds" || what == "models" || what == "behaviours";
  if (is_list && request.method != "GET") return MethodNotAllowed("GET");
  if (what == "worlds") return factory_->Worlds();
  if (what == "models") return factory_->Models();
  if (what == "behaviours") return factory_->Behaviours(request.target);
  return NoSuchAddress();
}

Response Api::List() const {
  std::vector<simulation::SimulationStatus> statuses;
  for (const SimulationPointer& simulation : directory_->List()) {
    statuses.push_back(simulation->status());
  }
  return JsonResponse(200, SimulationListJson(statuses));
}

Response Api::OfSimulation(const Request& request) {
  const std::vector<std::string>& path = request.target.segments;
  const SimulationPointer simulation = directory_->Find(path[2]);
  if (!simulation) return ErrorResponse(404, "there is no simulation '" + path[2] + "'");
  const bool is_get = request.method == "GET";
  if (path.size() == 3) {
    if (request.method == "DELETE" && factory_) return factory_->Destroy(path[2]);
    return is_get ? StatusOf(*simulation) : MethodNotAllowed(factory_ ? "GET, DELETE" : "GET");
  }
  if (path.size() > 4) return OfBody(request, simulation);
  if (path[3] == "robots" && factory_) {
    return request.method == "POST" ? factory_->AddRobot(simulation, request.body)
                                    : MethodNotAllowed("POST");
  }
  if (path[3] == "objects" && factory_) {
    return request.method == "POST" ? factory_->AddObject(simulation, request.body)
                                    : MethodNotAllowed("POST");
  }
  if (path[3] == "scene") return is_get ? Scene(*simulation) : MethodNotAllowed("GET");
  if (path[3] == "recording") return Recording(request, simulation);
  const bool sets_factor = path[3] == "factor";
  const SimulationCommand* command = FindSimulationCommand(path[3]);
  if (command == nullptr && !sets_factor) return NoSuchAddress();
  if (request.method != "POST") return MethodNotAllowed("POST");
  const base::Status done = sets_factor ? SetFactor(*simulation, request.body)
                                        : Obey(*simulation, *command, request.body);
  if (!done) return ErrorResponse(done.error());
  return StatusOf(*simulation);
}

Response Api::Recording(const Request& request, const SimulationPointer& simulation) const {
  if (recordings_ == nullptr) return ErrorResponse(404, "this server does not record");
  const std::string& name = simulation->specification().name;
  if (request.method == "POST") {
    const base::Result<bool> record = ParseRecordingSwitch(request.body);
    if (!record) return ErrorResponse(record.error());
    const base::Status done =
        *record ? recordings_->Record(simulation) : recordings_->StopRecording(name);
    if (!done) return ErrorResponse(done.error());
  } else if (request.method != "GET") {
    return MethodNotAllowed("GET, POST");
  }
  return JsonResponse(200, RecordingJson(recordings_->RecordingOf(name)));
}

// Below /api/simulations/NAME: robots/ROBOT, objects/OBJECT, robots/ROBOT/drive,
// robots/ROBOT/topics and bodies/BODY/place.
Response Api::OfBody(const Request& request, const SimulationPointer& simulation) const {
  const std::vector<std::string>& path = request.target.segments;
  const bool is_post = request.method == "POST";
  if (path.size() == 5 && path[3] == "robots") {
    return request.method == "DELETE" ? RemoveRobot(*simulation, path[4])
                                      : MethodNotAllowed("DELETE");
  }
  if (path.size() == 5 && path[3] == "objects") {
    return request.method == "DELETE" ? RemoveObject(*simulation, path[4])
                                      : MethodNotAllowed("DELETE");
  }
  if (path.size() != 6) return NoSuchAddress();
  if (path[3] == "robots" && path[5] == "drive") {
    return is_post ? Drive(*simulation, path[4], request.body) : MethodNotAllowed("POST");
  }
  if (path[3] == "robots" && path[5] == "topics") {
    return request.method == "GET" ? Topics(simulation, path[4]) : MethodNotAllowed("GET");
  }
  if (path[3] == "bodies" && path[5] == "place") {
    return is_post ? PlaceBody(*simulation, path[4], request.body) : MethodNotAllowed("POST");
  }
  return NoSuchAddress();
}

// Looking changes nothing of the simulation; what is listed concerns those who look.
Response Api::Topics(const SimulationPointer& simulation, const std::string& robot) const {
  if (simulation->snapshot()->layout->Find(robot) < 0) {
    return ErrorResponse(404, "there is no robot '" + robot + "'");
  }
  if (list_sensors_) list_sensors_(simulation, robot);
  return JsonResponse(200, TopicsJson(SensorTopicNames(*simulation, robot)));
}

Response Api::Scene(const Simulation& simulation) {
  return JsonResponse(
      200, presentation::SceneJson(simulation, models_.identify(), models_.identify_collisions()));
}

}  // namespace gsv::gateway
