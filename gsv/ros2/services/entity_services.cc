#include "gsv/ros2/services/entity_services.h"

#include "gsv/base/spelling.h"
#include "gsv/ros2/services/entity_bounds.h"
#include "gsv/ros2/services/entity_filter.h"
#include "gsv/ros2/services/entity_messages.h"

namespace gsv::ros2 {
namespace {

namespace interfaces = messages::simulation_interfaces;
using simulation::Simulation;
using Lane = ServiceHost::Lane;

interfaces::Result ResultOfFilter(const base::Error& error) {
  const bool is_unsupported = error.code == base::ErrorCode::kUnavailable;
  return Failed(is_unsupported ? interfaces::Result::kResultFeatureUnsupported
                               : interfaces::Result::kResultOperationFailed,
                error.Sentence());
}

interfaces::GetEntitiesResponse GetEntities(const Simulation& simulation,
                                            const interfaces::GetEntitiesRequest& request) {
  interfaces::GetEntitiesResponse response;
  const auto snapshot = simulation.snapshot();
  const auto passed = FilterEntities(*snapshot, request.filters);
  response.result = passed ? Succeeded() : ResultOfFilter(passed.error());
  if (!passed) return response;
  for (const int body : *passed) {
    response.entities.push_back(snapshot->layout->bodies[static_cast<std::size_t>(body)].name);
  }
  return response;
}

interfaces::GetEntitiesStatesResponse GetEntitiesStates(
    const Simulation& simulation, const interfaces::GetEntitiesStatesRequest& request) {
  interfaces::GetEntitiesStatesResponse response;
  const auto snapshot = simulation.snapshot();
  const auto passed = FilterEntities(*snapshot, request.filters);
  response.result = passed ? Succeeded() : ResultOfFilter(passed.error());
  if (!passed) return response;
  for (const int body : *passed) {
    response.entities.push_back(snapshot->layout->bodies[static_cast<std::size_t>(body)].name);
    response.states.push_back(StateOf(*snapshot, body));
  }
  return response;
}

interfaces::GetEntityInfoResponse GetEntityInfo(const Simulation& simulation,
                                                const interfaces::GetEntityInfoRequest& request) {
  interfaces::GetEntityInfoResponse response;
  const auto snapshot = simulation.snapshot();
  const auto found = FindEntity(*snapshot, request.entity);
  response.result = found ? Succeeded() : ResultOf(found.error());
  if (!found) return response;
  const world::Body& body = snapshot->layout->bodies[static_cast<std::size_t>(*found)];
  response.info.category.category = CategoryOf(body);
  response.info.description = "model " + body.model->name;
  return response;
}

interfaces::GetEntityStateResponse GetEntityState(
    const Simulation& simulation, const interfaces::GetEntityStateRequest& request) {
  interfaces::GetEntityStateResponse response;
  const auto snapshot = simulation.snapshot();
  const auto found = FindEntity(*snapshot, request.entity);
  response.result = found ? Succeeded() : ResultOf(found.error());
  if (found) response.state = StateOf(*snapshot, *found);
  return response;
}

interfaces::GetEntityBoundsResponse GetEntityBounds(
    const Simulation& simulation, const interfaces::GetEntityBoundsRequest& request) {
  interfaces::GetEntityBoundsResponse response;
  const auto snapshot = simulation.snapshot();
  const auto found = FindEntity(*snapshot, request.entity);
  response.result = found ? Succeeded() : ResultOf(found.error());
  if (!found) return response;
  if (const auto bounds = BoundsOfBody(*snapshot, *found)) response.bounds = BoxOf(*bounds);
  return response;
}

bool IsAtRest(const interfaces::EntityState& state) {
  return state.twist == messages::geometry_msgs::Twist{} &&
         state.acceleration == messages::geometry_msgs::Accel{};
}

interfaces::SetEntityStateResponse SetEntityState(
    Simulation& simulation, const interfaces::SetEntityStateRequest& request) {
  const auto found = FindEntity(*simulation.snapshot(), request.entity);
  if (!found) return {ResultOf(found.error())};
  if (!IsAtRest(request.state)) {
    return {Failed(interfaces::Result::kResultFeatureUnsupported,
                   "velocities and accelerations cannot be set. Leave them zero")};
  }
  const auto pose = PoseIn(request.state.header.frame_id, request.state.pose);
  if (!pose) return {ResultOf(pose.error())};
  return {ResultOf(EditWhilePaused(simulation, [&] {
    return simulation.PlaceBody(request.entity, *pose, StandsOnTheFloor(*pose));
  }))};
}

}  // namespace

base::Result<int> FindEntity(const world::Snapshot& snapshot, const std::string& name) {
  const int body = snapshot.layout->Find(name);
  if (body >= 0) return body;
  std::vector<std::string> names;
  for (const world::Body& each : snapshot.layout->bodies) names.push_back(each.name);
  return base::Fail(base::ErrorCode::kNotFound,
                    "there is no entity of this name" + base::DidYouMean(name, names),
                    name.substr(0, 100));
}

void OfferEntityServices(ServedSimulation& served) {
  served.Offer<interfaces::GetEntitiesRequest, interfaces::GetEntitiesResponse>(
      "get_entities", "GetEntities", Lane::kLists, &GetEntities);
  served.Offer<interfaces::GetEntitiesStatesRequest, interfaces::GetEntitiesStatesResponse>(
      "get_entities_states", "GetEntitiesStates", Lane::kLists, &GetEntitiesStates);
  served.Offer<interfaces::GetEntityInfoRequest, interfaces::GetEntityInfoResponse>(
      "get_entity_info", "GetEntityInfo", Lane::kQuick, &GetEntityInfo);
  served.Offer<interfaces::GetEntityStateRequest, interfaces::GetEntityStateResponse>(
      "get_entity_state", "GetEntityState", Lane::kQuick, &GetEntityState);
  served.Offer<interfaces::GetEntityBoundsRequest, interfaces::GetEntityBoundsResponse>(
      "get_entity_bounds", "GetEntityBounds", Lane::kQuick, &GetEntityBounds);
  served.Offer<interfaces::SetEntityStateRequest, interfaces::SetEntityStateResponse>(
      "set_entity_state", "SetEntityState", Lane::kSlow, &SetEntityState);
  served.Offer<interfaces::SetEntityInfoRequest, interfaces::SetEntityInfoResponse>(
      "set_entity_info", "SetEntityInfo", Lane::kQuick,
      [](const Simulation&, const interfaces::SetEntityInfoRequest&) {
        return interfaces::SetEntityInfoResponse{
            Failed(interfaces::Result::kResultFeatureUnsupported,
                   "the category and the description of an entity follow from its model")};
      });
}

}  // namespace gsv::ros2
