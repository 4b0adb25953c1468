#include "gsv/ros2/services/world_services.h"

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
  if (!request.sources.empty()) return {NotSupported("further sources are not searched"), {}};
  if (!request.filter.tags.empty()) return {NotSupported("worlds have no tags"), {}};
  interfaces::GetAvailableWorldsResponse response;
  response.result = Succeeded();
  for (Spawner::World& each : served.spawner->Worlds()) {
    interfaces::WorldResource world;
    world.description = "start it with gsv run " + each.name;
    world.name = std::move(each.name);
    world.world_resource.uri = std::move(each.uri);
    response.worlds.push_back(std::move(world));
  }
  return response;
}

constexpr const char* kOneWorld =
    "a simulation keeps its world. Start another one with gsv run WORLD --ros2";
constexpr const char* kNoNamedPoses = "worlds of gsv have no named poses";

}  // namespace

void OfferWorldServices(ServedSimulation& served) {
  served.Offer<interfaces::GetCurrentWorldRequest, interfaces::GetCurrentWorldResponse>(
      "get_current_world", "GetCurrentWorld", Lane::kQuick, &CurrentWorld);
  served.Offer<interfaces::GetAvailableWorldsRequest, interfaces::GetAvailableWorldsResponse>(
      "get_available_worlds", "GetAvailableWorlds", Lane::kSlow,
      [&served](const Simulation&, const interfaces::GetAvailableWorldsRequest& request) {
        return AvailableWorlds(served, request);
      });
  served.Offer<interfaces::LoadWorldRequest, interfaces::LoadWorldResponse>(
      "load_world", "LoadWorld", Lane::kQuick,
      [](const Simulation&, const interfaces::LoadWorldRequest&) {
        return interfaces::LoadWorldResponse{NotSupported(kOneWorld), {}};
      });
  served.Offer<interfaces::UnloadWorldRequest, interfaces::UnloadWorldResponse>(
      "unload_world", "UnloadWorld", Lane::kQuick,
      [](const Simulation&, const interfaces::UnloadWorldRequest&) {
        return interfaces::UnloadWorldResponse{NotSupported(kOneWorld)};
      });
  served.Offer<interfaces::GetNamedPosesRequest, interfaces::GetNamedPosesResponse>(
      "get_named_poses", "GetNamedPoses", Lane::kQuick,
      [](const Simulation&, const interfaces::GetNamedPosesRequest&) {
        return interfaces::GetNamedPosesResponse{NotSupported(kNoNamedPoses), {}};
      });
  served.Offer<interfaces::GetNamedPoseBoundsRequest, interfaces::GetNamedPoseBoundsResponse>(
      "get_named_pose_bounds", "GetNamedPoseBounds", Lane::kQuick,
      [](const Simulation&, const interfaces::GetNamedPoseBoundsRequest&) {
        return interfaces::GetNamedPoseBoundsResponse{NotSupported(kNoNamedPoses), {}};
      });
}

}  // namespace gsv::ros2
