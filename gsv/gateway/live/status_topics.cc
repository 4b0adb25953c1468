#include "gsv/gateway/live/status_topics.h"

#include <utility>

#include "gsv/gateway/foxglove/channels.h"
#include "gsv/presentation/run_messages.h"

namespace gsv::gateway {
namespace {

constexpr double kStatusRate = 5;       // Hz, of wall-clock time
constexpr double kDiagnosticsRate = 1;  // the rate of ROS's own publishers

SharedBytes EncodedStatus(const simulation::SimulationStatus& status) {
  return Encoded(presentation::StatusMessage(status));
}

SharedBytes EncodedDiagnostics(const simulation::SimulationStatus& status) {
  return Encoded(presentation::DiagnosticsMessage(status));
}

}  // namespace

StatusTopics::StatusTopics(std::shared_ptr<Hub> hub) : hub_(std::move(hub)) {
  const auto channels = hub_->Advertise(
      {ChannelFor(presentation::topics::kStatus), ChannelFor(presentation::topics::kDiagnostics)});
  topics_.push_back({channels[0], EncodedStatus, Pacing(kStatusRate)});
  topics_.push_back({channels[1], EncodedDiagnostics, Pacing(kDiagnosticsRate)});
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
  const Hub::Message message{base::NanosecondsOf(status.time), topic.encode(status)};
  if (is_due) {
    topic.pacing.Done(now);
    topic.phase = status.phase;
  }
  const bool has_changed = message.payload.view() != topic.latest.payload.view();
  topic.latest = message;
  if (has_changed) return hub_->Publish(topic.channel, message);
  if (has_newcomers) hub_->Welcome(topic.channel, {&message, 1});
}

}  // namespace gsv::gateway
