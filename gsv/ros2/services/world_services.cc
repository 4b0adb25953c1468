#include "gsv/ros2/services/world_services.h"

#include <utility>

#include "gsv/ros2/services/entity_messages.h"

namespace gsv::ros2 {
namespace {

namespace interfaces = messages::simulation_interfaces;
using simulation::Simulation;
using Lane = ServiceHost::Lane;

interfaces::Result NotSupported(const char* why) {
  return Failed(interfaces::Result::kResultFeatureUnsupported, why);
}

interfaces::GetCurrentWorldResponse CurrentWorld(const Simulation& simulation,
                                                 const interfaces::GetCurrentWorldRequest&) {
  interfaces::GetCurrentWorldResponse response;
  const model::WorldDescription& world = *simulation.specification().world;
  response.result = Succeeded();
  response.world.name = world.name;
  response.world.world_resource.uri = world.source;
  return response;
}

interfaces::GetAvailableWorldsResponse AvailableWorlds(
    const ServedSimulation& served, const interfaces::GetAvailableWorldsRequest& request) {
  if (served.spawner == nullptr) return {NotSupported("this program lists no worlds"), {}};
  if (!request.sources.empty()) return {NotSupported("additional sources are not supported"), {}};
  if (!request.filter.tags.empty()) return {NotSupported("worlds have no tags"), {}};
  interfaces::GetAvailableWorldsResponse response;
  response.result = Succeeded();
  for (Spawner::World& each : served.spawner->Worlds()) {
    interfaces::WorldResource world;
    if (!served.loads_worlds()) world.description = "start it with gsv run " + each.name;
    world.name = std::move(each.name);
    world.world_resource.uri = std::move(each.uri);
    response.worlds.push_back(std::move(world));
  }
  return response;
}

using LoadResponse = interfaces::LoadWorldResponse;

constexpr const char* kKeepsItsWorld =
    "`gsv run` keeps its world. To load worlds, start `gsv serve --ros2`";

LoadResponse NotLoaded(const base::Error& error) {
  switch (error.code) {
    case base::ErrorCode::kInvalidArgument:
      return {Failed(LoadResponse::kUnsupportedFormat, error.Sentence()), {}};
    case base::ErrorCode::kBadModel:
      return {Failed(LoadResponse::kResourceParseError, error.Sentence()), {}};
    case base::ErrorCode::kCorrupt:
      return {Failed(LoadResponse::kUnsupportedElements, error.Sentence()), {}};
    default:
      return {ResultOf(error), {}};
  }
}

LoadResponse LoadWorld(const ServedSimulation& served,
                       const interfaces::LoadWorldRequest& request) {
  if (!served.loads_worlds()) return {NotSupported(kKeepsItsWorld), {}};
  if (request.uri.empty()) {
    if (!request.resource_string.empty()) {
      return {NotSupported("a resource_string is not supported. Give a uri"), {}};
    }
    return {Failed(LoadResponse::kNoResource,
                   "the request has no uri. GetAvailableWorlds lists worlds"),
            {}};
  }
  const auto loaded = served.spawner->LoadWorld(request.uri, request.fail_on_unsupported_element);
  if (!loaded) return NotLoaded(loaded.error());
  const auto simulation = served.simulation();
  // Meanwhile, another client may have unloaded the world.
  if (simulation == nullptr) return {served.NoSimulation(), {}};
  return {Succeeded(), CurrentWorld(*simulation, {}).world};
}

interfaces::UnloadWorldResponse UnloadWorld(const ServedSimulation& served) {
  if (!served.loads_worlds()) return {NotSupported(kKeepsItsWorld)};
  const auto unloaded = served.spawner->UnloadWorld();
  if (unloaded) return {Succeeded()};
  if (unloaded.error().code == base::ErrorCode::kNotFound) {
    return {Failed(interfaces::UnloadWorldResponse::kNoWorldLoaded, unloaded.error().Sentence())};
  }
  return {ResultOf(unloaded.error())};
}

interfaces::GetNamedPosesResponse NamedPoses(const ServedSimulation& served,
                                             const Simulation& simulation,
                                             const interfaces::GetNamedPosesRequest& request) {
  if (served.spawner == nullptr) return {NotSupported("this program reads no named poses"), {}};
  if (!request.tags.tags.empty()) return {NotSupported("named poses have no tags"), {}};
  const auto poses = served.spawner->NamedPoses(simulation);
  if (!poses) return {ResultOf(poses.error()), {}};
  interfaces::GetNamedPosesResponse response;
  response.result = Succeeded();
  for (const Spawner::NamedPose& each : *poses) {
    interfaces::NamedPose pose;
    pose.name = each.name;
    pose.pose = MessageOf(each.world_from_pose);
    response.poses.push_back(std::move(pose));
  }
  return response;
}

}  // namespace

void OfferWorldServices(ServedSimulation& served) {
  served.Offer<interfaces::GetCurrentWorldRequest, interfaces::GetCurrentWorldResponse>(
      "get_current_world", "GetCurrentWorld", Lane::kQuick, &CurrentWorld);
  served.host.Offer<interfaces::GetAvailableWorldsRequest>(
      served.node + "/get_available_worlds", "simulation_interfaces/srv/GetAvailableWorlds",
      Lane::kSlow, [&served](const interfaces::GetAvailableWorldsRequest& request) {
        return AvailableWorlds(served, request);
      });
  served.host.Offer<interfaces::LoadWorldRequest>(
      served.node + "/load_world", "simulation_interfaces/srv/LoadWorld", Lane::kSlow,
      [&served](const interfaces::LoadWorldRequest& request) {
        return LoadWorld(served, request);
      });
  served.host.Offer<interfaces::UnloadWorldRequest>(
      served.node + "/unload_world", "simulation_interfaces/srv/UnloadWorld", Lane::kSlow,
      [&served](const interfaces::UnloadWorldRequest&) { return UnloadWorld(served); });
  served.Offer<interfaces::GetNamedPosesRequest, interfaces::GetNamedPosesResponse>(
      "get_named_poses", "GetNamedPoses", Lane::kSlow,
      [&served](const Simulation& simulation, const interfaces::GetNamedPosesRequest& request) {
        return NamedPoses(served, simulation, request);
      });
  served.Offer<interfaces::GetNamedPoseBoundsRequest, interfaces::GetNamedPoseBoundsResponse>(
      "get_named_pose_bounds", "GetNamedPoseBounds", Lane::kQuick,
      [](const Simulation&, const interfaces::GetNamedPoseBoundsRequest&) {
        return interfaces::GetNamedPoseBoundsResponse{NotSupported("named poses have no bounds"),
                                                      {}};
      });
}

}  // namespace gsv::ros2
