#include "gsv/presentation/health_messages.h"

#include <algorithm>
#include <array>

#include "gsv/messages/time.h"

namespace gsv::presentation {
namespace {

messages::gsv_msgs::RobotHealth RobotHealthMessage(const health::RobotHealth& health) {
  messages::gsv_msgs::RobotHealth message;
  message.robot = health.robot;
  message.state = health::ToString(health.state);
  message.level = static_cast<std::uint8_t>(health.level);
  message.since = messages::ToMessage(health.since);
  message.command_linear_m_s = health.command.linear;
  message.command_lateral_m_s = health.command.lateral;
  message.command_angular_rad_s = health.command.angular;
  message.linear_m_s = health.linear;
  message.angular_rad_s = health.angular;
  if (health.limit) {
    message.limit_sensor = health.limit->sensor;
    message.limit_value = health.limit->value;
    message.limit_unit = "m";
  }
  message.contact = health.contact;
  message.summary = health.summary;
  message.reason = health.reason;
  return message;
}

messages::gsv_msgs::Expectation ExpectationMessage(const simulation::ExpectationState& state) {
  messages::gsv_msgs::Expectation message;
  message.name = state.name;
  message.yaml = state.yaml;
  message.where = state.where;
  message.state = simulation::ToString(state.verdict);
  message.has_margin = state.margin.has_value();
  message.margin = state.margin.value_or(0);
  message.unit = state.unit;
  message.margin_at_s = base::ToSeconds(state.margin_at);
  message.time_s = base::ToSeconds(state.time);
  message.step = static_cast<std::uint64_t>(state.step);
  message.detail = state.detail;
  message.bodies = state.bodies;
  for (const auto& [x, y, radius] : state.places) {
    message.places.insert(message.places.end(), {x, y, radius});
  }
  for (const auto& [x_min, x_max, y_min, y_max] : state.boxes) {
    message.boxes.insert(message.boxes.end(), {x_min, x_max, y_min, y_max});
  }
  return message;
}

}  // namespace

messages::gsv_msgs::Health HealthMessage(const health::Report& report) {
  messages::gsv_msgs::Health message;
  message.stamp = messages::ToMessage(report.time);
  message.step = static_cast<std::uint64_t>(report.step);
  message.stuck_after_s = base::ToSeconds(report.stuck_after);
  message.moving = report.CountOf(health::State::kMoving);
  message.standing = report.CountOf(health::State::kStanding);
  message.stuck = report.CountOf(health::State::kStuck);
  message.contact = report.CountOf(health::State::kContact);
  message.dead = report.CountOf(health::State::kDead);
  message.late = report.CountOf(health::State::kLate);
  for (const health::RobotHealth& robot : report.robots) {
    if (robot.state != health::State::kMoving) message.robots.push_back(RobotHealthMessage(robot));
  }
  return message;
}

bool NeedsSending(const messages::gsv_msgs::Health& message,
                  const messages::gsv_msgs::Health& sent) {
  const auto counts = [](const messages::gsv_msgs::Health& of) {
    return std::array{of.moving, of.standing, of.stuck, of.contact, of.dead, of.late};
  };
  const auto is_same = [](const auto& a, const auto& b) {
    return a.robot == b.robot && a.state == b.state && a.level == b.level &&
           a.since.sec == b.since.sec && a.since.nanosec == b.since.nanosec &&
           a.contact == b.contact && a.limit_value == b.limit_value && a.reason == b.reason;
  };
  return counts(message) != counts(sent) || message.robots.size() != sent.robots.size() ||
         !std::equal(message.robots.begin(), message.robots.end(), sent.robots.begin(), is_same);
}

messages::gsv_msgs::Expectations ExpectationsMessage(
    base::SimTime time, const std::vector<simulation::ExpectationState>& states) {
  messages::gsv_msgs::Expectations message;
  message.stamp = messages::ToMessage(time);
  for (const simulation::ExpectationState& state : states) {
    message.expectations.push_back(ExpectationMessage(state));
  }
  return message;
}

}  // namespace gsv::presentation
