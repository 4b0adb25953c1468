// Fuzzes the input from other participants: commands, service requests, the node graph and the
// USER_DATA of endpoints.
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "gsv/messages/cdr.h"
#include "gsv/messages/geometry_msgs.h"
#include "gsv/messages/rcl_interfaces.h"
#include "gsv/ros2/commands.h"
#include "gsv/ros2/graph.h"
#include "gsv/ros2/joint_trajectory.h"
#include "gsv/ros2/names.h"
#include "gsv/ros2/services/entity_filter.h"
#include "gsv/ros2/services/entity_messages.h"
#include "gsv/ros2/services/goal_list.h"
#include "gsv/ros2/types/type_hash.h"

namespace {

const gsv::model::Model& OneJoint() {
  static const gsv::model::Model kModel = [] {
    gsv::model::Model model;
    model.joints.resize(1);
    model.joints[0].name = "joint";
    return model;
  }();
  return kModel;
}

// A snapshot of two bodies without shapes.
const gsv::world::Snapshot& TwoBodies() {
  static const gsv::world::Snapshot kSnapshot = [] {
    gsv::model::Model model;
    model.links.resize(1);
    std::vector<gsv::world::Body> bodies(2);
    for (gsv::world::Body& body : bodies) body.model = std::make_shared<gsv::model::Model>(model);
    bodies[0].name = "pebble";
    bodies[1].name = "wall";
    gsv::world::Snapshot snapshot;
    snapshot.layout =
        gsv::world::MakeLayout(1, bodies, std::make_shared<gsv::model::WorldDescription>());
    snapshot.state = gsv::world::InitialState(*snapshot.layout);
    return snapshot;
  }();
  return kSnapshot;
}

void TakeRequests(std::span<const std::byte> bytes) {
  using namespace gsv;
  namespace interfaces = messages::simulation_interfaces;
  if (const auto request = messages::Decode<interfaces::GetEntitiesRequest>(bytes)) {
    (void)ros2::FilterEntities(TwoBodies(), request->filters);
  }
  if (const auto request = messages::Decode<interfaces::SetEntityStateRequest>(bytes)) {
    (void)ros2::PoseIn(request->state.header.frame_id, request->state.pose);
  }
  if (const auto request = messages::Decode<messages::action_msgs::CancelGoalRequest>(bytes)) {
    ros2::GoalList goals;
    (void)goals.Accept({1}, {});
    (void)goals.Cancel(*request);
  }
  (void)messages::Decode<interfaces::SpawnEntityRequest>(bytes);
  (void)messages::Decode<interfaces::GetAvailableWorldsRequest>(bytes);
  (void)messages::Decode<interfaces::SetEntityInfoRequest>(bytes);
  (void)messages::Decode<interfaces::LoadWorldRequest>(bytes);
  (void)messages::Decode<interfaces::GetNamedPosesRequest>(bytes);
  (void)messages::Decode<interfaces::SimulateStepsSendGoalRequest>(bytes);
  (void)messages::Decode<messages::rcl_interfaces::SetParametersRequest>(bytes);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace gsv;
  const auto bytes = std::as_bytes(std::span(data, size));
  (void)messages::Decode<messages::geometry_msgs::Twist>(bytes);
  (void)messages::Decode<messages::geometry_msgs::TwistStamped>(bytes);
  (void)ros2::DecodeFloat64MultiArray(bytes);
  (void)ros2::DecodeGraph(bytes);
  (void)ros2::ReadJointTrajectory(bytes, OneJoint(), {0});
  TakeRequests(bytes);
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  (void)ros2::TypeHashIn(text);
  (void)ros2::RosTopicName(text);
  (void)ros2::RosTypeName(text);
  return 0;
}
