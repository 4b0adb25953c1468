#include "gsv/gateway/live/status_topics.h"

#include <algorithm>
#include <functional>
#include <string>
#include <utility>

#include "gsv/gateway/foxglove/channels.h"
#include "gsv/presentation/run_messages.h"

namespace gsv::gateway {
namespace {

constexpr double kDiagnosticsRate = 1;  // Hz; ROS's own nodes publish diagnostics at this rate

SharedBytes EncodedStatus(const simulation::SimulationStatus& status) {
  return Encoded(presentation::StatusMessage(status));
}

SharedBytes EncodedDiagnostics(const simulation::SimulationStatus& status) {
  return Encoded(presentation::DiagnosticsMessage(status));
}

// Returns a hash of the status without its times, counters and real-time factors.
std::uint64_t StatesOf(const simulation::SimulationStatus& status) {
  std::size_t hash = static_cast<std::size_t>(status.phase);
  const auto add = [&hash](std::size_t value) { hash = hash * 1099511628211u ^ value; };
  const auto add_text = [&](const std::string& text) { add(std::hash<std::string>()(text)); };
  add_text(status.waiting_for);
  for (const simulation::RobotStatus& robot : status.robots) {
    add_text(robot.name);
    add_text(robot.behaviour);
    add_text(robot.detail);
    const bool is_ended = robot.phase == simulation::AgentPhase::kDead ||
                          robot.phase == simulation::AgentPhase::kUnresponsive ||
                          robot.phase == simulation::AgentPhase::kFinished;
    add(is_ended ? static_cast<std::size_t>(robot.phase) : 0);
  }
  return hash;
}

}  // namespace

StatusTopics::StatusTopics(std::shared_ptr<Hub> hub) : hub_(std::move(hub)) {
  const auto channels = hub_->Advertise(
      {ChannelFor(presentation::topics::kStatus), ChannelFor(presentation::topics::kDiagnostics)});
  topics_.push_back({channels[0], EncodedStatus, Pacing(kStatusRate), kMaxStatusBytesPerSecond});
  topics_.push_back({channels[1], EncodedDiagnostics, Pacing(kDiagnosticsRate)});
}

double StatusTopics::RateFor(const Topic& topic, std::size_t size) {
  if (!topic.max_bytes_per_second) return kStatusRate;
  const double bytes = static_cast<double>(std::max<std::size_t>(1, size));
  return std::clamp(*topic.max_bytes_per_second / bytes, kMinStatusRate, kStatusRate);
}

void StatusTopics::Publish(const simulation::Simulation& simulation, WallTime now) {
  for (Topic& topic : topics_) {
    if (hub_->IsSubscribed(topic.channel)) Publish(topic, simulation, now);
  }
}

void StatusTopics::Publish(Topic& topic, const simulation::Simulation& simulation, WallTime now) {
  const simulation::Phase phase = simulation.WaitForPhase({}, std::chrono::milliseconds(0));
  const bool is_due = phase != topic.phase || topic.pacing.IsDue(now);
  const bool has_newcomers = hub_->HasNewSubscribers(topic.channel);
  if (!is_due && !has_newcomers) return;
  const simulation::SimulationStatus status = simulation.status();
  const std::uint64_t states = StatesOf(status);
  const bool has_news = phase != topic.phase || states != topic.states;
  const bool may_send = has_news || topic.counters_pacing.IsDue(now);
  if (is_due) topic.pacing.Done(now);
  if (!may_send && !has_newcomers) return;
  const Hub::Message message{base::NanosecondsOf(status.time), topic.encode(status)};
  if (is_due && may_send) {
    topic.phase = status.phase;
    topic.states = states;
    topic.counters_pacing.SetRate(RateFor(topic, message.payload.size()));
    topic.counters_pacing.Done(now);
  }
  const bool has_changed = message.payload.view() != topic.latest.payload.view();
  topic.latest = message;
  if (has_changed) return hub_->Publish(topic.channel, message);
  if (has_newcomers) hub_->Welcome(topic.channel, {&message, 1});
}

}  // namespace gsv::gateway
