#include "gsv/ros2/services/spawn_services.h"

#include "gsv/ros2/services/entity_messages.h"
#include "gsv/ros2/services/entity_services.h"

namespace gsv::ros2 {
namespace {

namespace interfaces = messages::simulation_interfaces;
using simulation::Simulation;
using Lane = ServiceHost::Lane;

// Numbers below this are appended to a name to make it unique.
constexpr int kMaxNumber = 10'000;
constexpr std::size_t kMaxName = 200;

using SpawnResponse = interfaces::SpawnEntityResponse;

SpawnResponse NotSpawned(std::uint8_t code, std::string why) {
  return {Failed(code, std::move(why)), {}};
}

SpawnResponse NotSpawned(const base::Error& error) {
  switch (error.code) {
    case base::ErrorCode::kInvalidArgument:
      return NotSpawned(SpawnResponse::kUnsupportedFormat, error.Sentence());
    case base::ErrorCode::kCorrupt:
      return NotSpawned(SpawnResponse::kResourceParseError, error.Sentence());
    default:
      return {ResultOf(error), {}};
  }
}

bool IsTaken(const Simulation& simulation, const std::string& name) {
  return simulation.snapshot()->layout->Find(name) >= 0;
}

// Returns `wanted` if this name is free, otherwise `wanted` with a number. Returns an empty text if
// no number is free.
std::string FreeName(const Simulation& simulation, const std::string& wanted) {
  if (!IsTaken(simulation, wanted)) return wanted;
  for (int i = 2; i < kMaxNumber; ++i) {
    std::string name = wanted + "_" + std::to_string(i);
    if (!IsTaken(simulation, name)) return name;
  }
  return {};
}

SpawnResponse Spawn(ServedSimulation& served, Simulation& simulation,
                    const interfaces::SpawnEntityRequest& request) {
  if (served.spawner == nullptr) {
    return NotSpawned(interfaces::Result::kResultFeatureUnsupported,
                      "this program cannot add entities");
  }
  if (request.entity_resource.uri.empty()) {
    return request.entity_resource.resource_string.empty()
               ? NotSpawned(SpawnResponse::kNoResource,
                            "entity_resource has no uri. GetSpawnables lists them")
               : NotSpawned(interfaces::Result::kResultFeatureUnsupported,
                            "a resource_string is not supported. Give a uri");
  }
  if (request.name.size() > kMaxName) {
    return NotSpawned(SpawnResponse::kNameInvalid, "the name is longer than 200 bytes");
  }
  const auto pose = PoseIn(request.initial_pose.header.frame_id, request.initial_pose.pose);
  if (!pose) return NotSpawned(SpawnResponse::kInvalidPose, pose.error().Sentence());
  SpawnRequest spawn;
  spawn.uri = request.entity_resource.uri;
  spawn.name = request.name;
  spawn.world_from_entity = *pose;
  spawn.on_ground = StandsOnTheFloor(*pose);
  if (!spawn.name.empty() && request.allow_renaming) spawn.name = FreeName(simulation, spawn.name);
  if (!request.name.empty() && (spawn.name.empty() || IsTaken(simulation, spawn.name))) {
    return NotSpawned(SpawnResponse::kNameNotUnique,
                      "an entity named " + request.name + " exists already; set allow_renaming");
  }
  const base::Result<std::string> name = served.spawner->Spawn(simulation, spawn);
  if (!name) return NotSpawned(name.error());
  served.spawned().insert(*name);
  if (const auto ok = served.SetNamespaceOf(*name, request.entity_namespace); !ok) {
    (void)RemoveEntity(simulation, *name);
    served.spawned().erase(*name);
    return NotSpawned(SpawnResponse::kNamespaceInvalid, ok.error().Sentence());
  }
  return {Succeeded(), *name};
}

interfaces::GetSpawnablesResponse GetSpawnables(ServedSimulation& served,
                                                const interfaces::GetSpawnablesRequest& request) {
  interfaces::GetSpawnablesResponse response;
  response.result = Succeeded();
  if (!request.sources.empty()) {
    response.result = Failed(interfaces::Result::kResultFeatureUnsupported,
                             "additional sources are not supported. Start gsv with --model-path");
    return response;
  }
  if (served.spawner == nullptr) return response;
  for (Spawner::Spawnable& each : served.spawner->Spawnables()) {
    interfaces::Spawnable spawnable;
    spawnable.entity_resource.uri = std::move(each.uri);
    spawnable.description = each.is_robot ? "robot" : "object";
    response.spawnables.push_back(std::move(spawnable));
  }
  return response;
}

}  // namespace

base::Status RemoveEntity(Simulation& simulation, const std::string& name) {
  const auto snapshot = simulation.snapshot();
  const auto found = FindEntity(*snapshot, name);
  if (!found) return base::Fail(found.error());
  const world::Body& body = snapshot->layout->bodies[static_cast<std::size_t>(*found)];
  if (body.is_robot()) return simulation.RemoveRobot(name);
  return EditWhilePaused(simulation, [&] { return simulation.RemoveObject(name); });
}

void OfferSpawnServices(ServedSimulation& served) {
  served.Offer<interfaces::SpawnEntityRequest, SpawnResponse>(
      "spawn_entity", "SpawnEntity", Lane::kSlow,
      [&served](Simulation& simulation, const interfaces::SpawnEntityRequest& request) {
        return Spawn(served, simulation, request);
      });
  served.Offer<interfaces::GetSpawnablesRequest, interfaces::GetSpawnablesResponse>(
      "get_spawnables", "GetSpawnables", Lane::kSlow,
      [&served](Simulation&, const interfaces::GetSpawnablesRequest& request) {
        return GetSpawnables(served, request);
      });
  served.Offer<interfaces::DeleteEntityRequest, interfaces::DeleteEntityResponse>(
      "delete_entity", "DeleteEntity", Lane::kSlow,
      [&served](Simulation& simulation, const interfaces::DeleteEntityRequest& request) {
        const base::Status removed = RemoveEntity(simulation, request.entity);
        if (removed) served.spawned().erase(request.entity);
        return interfaces::DeleteEntityResponse{ResultOf(removed)};
      });
}

}  // namespace gsv::ros2
