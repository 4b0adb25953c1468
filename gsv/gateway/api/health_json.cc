#include "gsv/gateway/api/health_json.h"

#include <nlohmann/json.hpp>

#include "gsv/health/health_tracker.h"

namespace gsv::gateway {
namespace {

using OrderedJson = nlohmann::ordered_json;

// The health of a robot contains the last lines that its behaviour printed, at most this number.
constexpr std::size_t kLastLines = 20;

std::string HealthText(const OrderedJson& json) {
  return json.dump(-1, ' ', false, OrderedJson::error_handler_t::replace);
}

OrderedJson LineJson(const simulation::Event& line) {
  const bool is_end = line.kind == simulation::kProgramEndedEvent;
  return {{"time_s", base::ToSeconds(line.time)},
          {"robot", line.robot},
          {"stream", is_end ? "" : line.kind},
          {"text", line.detail}};
}

OrderedJson LinesOf(const std::vector<simulation::Event>& lines, const std::string& robot) {
  OrderedJson list = OrderedJson::array();
  for (auto line = lines.rbegin(); line != lines.rend() && list.size() < kLastLines; ++line) {
    if (line->robot == robot) list.insert(list.begin(), LineJson(*line));
  }
  return list;
}

OrderedJson ToJson(const health::RobotHealth& health, base::SimTime now) {
  OrderedJson json{{"name", health.robot},
                   {"state", health::ToString(health.state)},
                   {"level", static_cast<int>(health.level)},
                   {"since_s", base::ToSeconds(health.since)},
                   {"for_s", base::ToSeconds(now - health.since)},
                   {"command",
                    {{"linear_m_s", health.command.linear},
                     {"lateral_m_s", health.command.lateral},
                     {"angular_rad_s", health.command.angular}}},
                   {"actual", {{"linear_m_s", health.linear}, {"angular_rad_s", health.angular}}},
                   {"limit", nullptr},
                   {"contact", health.contact},
                   {"sentence", health::Sentence(health, now)}};
  if (health.limit) {
    json["limit"] = {
        {"sensor", health.limit->sensor}, {"value", health.limit->value}, {"unit", "m"}};
  }
  return json;
}

OrderedJson ToJson(const simulation::ExpectationState& state) {
  OrderedJson places = OrderedJson::array(), boxes = OrderedJson::array();
  for (const auto& [x, y, radius] : state.places) places.push_back({x, y, radius});
  for (const auto& [x_min, x_max, y_min, y_max] : state.boxes) {
    boxes.push_back({x_min, x_max, y_min, y_max});
  }
  OrderedJson json{{"name", state.name},
                   {"yaml", state.yaml},
                   {"where", state.where},
                   {"state", simulation::ToString(state.verdict)},
                   {"margin", nullptr},
                   {"unit", state.unit},
                   {"margin_at_s", base::ToSeconds(state.margin_at)},
                   {"time_s", base::ToSeconds(state.time)},
                   {"step", state.step},
                   {"detail", state.detail},
                   {"bodies", state.bodies},
                   {"places", std::move(places)},
                   {"boxes", std::move(boxes)}};
  if (state.margin) json["margin"] = *state.margin;
  return json;
}

}  // namespace

std::string HealthJson(simulation::Simulation& simulation, const std::string& robot) {
  const health::Report report = health::HealthNow(simulation);
  const std::vector<simulation::Event> lines = simulation.outputs(0);
  OrderedJson counts = OrderedJson::object();
  for (std::size_t i = 0; i < health::kStates; ++i) {
    counts[health::ToString(static_cast<health::State>(i))] = report.counts[i];
  }
  OrderedJson robots = OrderedJson::array();
  for (const health::RobotHealth& health : report.robots) {
    if (!robot.empty() && health.robot != robot) continue;
    OrderedJson json = ToJson(health, report.time);
    json["output"] = LinesOf(lines, health.robot);
    robots.push_back(std::move(json));
  }
  OrderedJson expectations = OrderedJson::array();
  for (const auto& state : simulation.expectations()) expectations.push_back(ToJson(state));
  return HealthText({{"time_s", base::ToSeconds(report.time)},
                     {"stuck_after_s", base::ToSeconds(report.stuck_after)},
                     {"counts", std::move(counts)},
                     {"robots", std::move(robots)},
                     {"expectations", std::move(expectations)}});
}

std::string OutputJson(const simulation::Simulation& simulation, const std::string& robot) {
  OrderedJson lines = OrderedJson::array();
  for (const simulation::Event& line : simulation.outputs(0)) {
    if (robot.empty() || line.robot == robot) lines.push_back(LineJson(line));
  }
  return HealthText({{"lines", std::move(lines)}});
}

}  // namespace gsv::gateway
