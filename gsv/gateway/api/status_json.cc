#include "gsv/gateway/api/status_json.h"

#include <nlohmann/json.hpp>

#include "gsv/health/health.h"

namespace gsv::gateway {
namespace {

using OrderedJson = nlohmann::ordered_json;

// Names and messages may have bytes that are not UTF-8; they are replaced.
std::string Dump(const OrderedJson& json) {
  return json.dump(-1, ' ', false, OrderedJson::error_handler_t::replace);
}

OrderedJson ShortHealthJson(const health::RobotHealth& health) {
  return {{"state", health::ToString(health.state)},
          {"level", static_cast<int>(health.level)},
          {"since_s", base::ToSeconds(health.since)}};
}

OrderedJson RobotJson(const simulation::RobotStatus& robot) {
  const geometry::Vector3& position = robot.world_from_robot.position;
  OrderedJson json{{"name", robot.name},
                   {"model", robot.model},
                   {"behaviour", robot.behaviour},
                   {"is_avatar", robot.is_avatar},
                   {"agent_phase", simulation::ToString(robot.phase)},
                   {"detail", robot.detail},
                   {"pose",
                    {{"x_m", position.x},
                     {"y_m", position.y},
                     {"z_m", position.z},
                     {"yaw_rad", geometry::Yaw(robot.world_from_robot.orientation)}}},
                   {"distance_m", robot.distance},
                   {"collisions", robot.collisions}};
  if (robot.is_station) json["is_station"] = true;
  return json;
}

OrderedJson ToJson(const simulation::SimulationStatus& status) {
  OrderedJson robots = OrderedJson::array();
  for (const simulation::RobotStatus& robot : status.robots) robots.push_back(RobotJson(robot));
  return {{"name", status.name},
          {"phase", simulation::ToString(status.phase)},
          {"mode", simulation::ToString(status.mode)},
          {"step", status.step},
          {"time_s", base::ToSeconds(status.time)},
          {"step_size_s", base::ToSeconds(status.step_size)},
          {"target_factor", status.target_factor},
          {"real_time_factor", status.real_time_factor},
          {"late_steps", status.late_steps},
          {"waiting_for", status.waiting_for},
          {"failure", status.failure},
          {"robots", std::move(robots)}};
}

OrderedJson ToJson(const ReplayClock& clock) {
  return {{"start_s", base::ToSeconds(clock.start())},
          {"end_s", base::ToSeconds(clock.end())},
          {"time_s", base::ToSeconds(clock.position())},
          {"speed", clock.speed()},
          {"loop", clock.loop()}};
}

}  // namespace

std::string StatusJson(const simulation::SimulationStatus& status) {
  OrderedJson json = ToJson(status);
  for (std::size_t i = 0; i < status.robots.size(); ++i) {
    if (status.robots[i].is_station) continue;
    json["robots"][i]["health"] = ShortHealthJson(health::HealthOf(status.robots[i], status));
  }
  return Dump(json);
}

std::string StatusJson(const simulation::SimulationStatus& status, const ReplayClock& replay) {
  OrderedJson json = ToJson(status);
  json["replay"] = ToJson(replay);
  return Dump(json);
}

std::string ReplayJson(const ReplayClock& clock) { return Dump(ToJson(clock)); }

std::string RecordingJson(const RecordingSwitch::State& state) {
  return Dump({{"recording", state.is_recording},
               {"path", state.path},
               {"messages", state.messages},
               {"dropped_messages", state.dropped},
               {"size_bytes", state.bytes}});
}

std::string TopicsJson(const std::vector<std::string>& topics) {
  return Dump({{"topics", topics}});
}

std::string SimulationListJson(const std::vector<simulation::SimulationStatus>& simulations) {
  OrderedJson list = OrderedJson::array();
  for (const simulation::SimulationStatus& status : simulations) {
    list.push_back({{"name", status.name},
                    {"phase", simulation::ToString(status.phase)},
                    {"mode", simulation::ToString(status.mode)},
                    {"time_s", base::ToSeconds(status.time)},
                    {"real_time_factor", status.real_time_factor},
                    {"robots", status.CountRobots()}});
  }
  return Dump(list);
}

}  // namespace gsv::gateway
