#include "gsv/gateway/live/event_topics.h"

#include <algorithm>
#include <utility>

#include "gsv/gateway/foxglove/channels.h"
#include "gsv/presentation/run_messages.h"

namespace gsv::gateway {
namespace {

namespace topics = presentation::topics;

SharedBytes EncodedEvent(const simulation::Event& event) {
  return Encoded(presentation::EventMessage(event));
}

SharedBytes EncodedLog(const simulation::Event& event) {
  return Encoded(presentation::LogMessage(event));
}

}  // namespace

EventTopics::EventTopics(std::shared_ptr<Hub> hub) : hub_(std::move(hub)) {
  const auto channels = hub_->Advertise({ChannelFor(topics::kEvents), ChannelFor(topics::kLog)});
  topics_ = {{channels[0], presentation::FindTopic(topics::kEvents.name)->history, EncodedEvent},
             {channels[1], presentation::FindTopic(topics::kLog.name)->history, EncodedLog}};
}

void EventTopics::Publish(const simulation::Simulation& simulation) {
  for (const simulation::Event& event : TakeNew(simulation)) {
    for (const Topic& topic : topics_) {
      if (!hub_->IsSubscribed(topic.channel)) continue;
      hub_->Publish(topic.channel, {base::NanosecondsOf(event.time), topic.encode(event)},
                    Hub::Audience::kEstablished);
    }
  }
  for (const Topic& topic : topics_) {
    if (hub_->HasNewSubscribers(topic.channel)) Welcome(topic, simulation);
  }
}

std::vector<simulation::Event> EventTopics::TakeNew(const simulation::Simulation& simulation) {
  if (simulation.events(next_).empty()) return {};
  // The simulation drops its oldest events, so that the count of all events gives the position. It
  // is read before the events, so that it is not ahead of them.
  const std::uint64_t count = simulation.status().events;
  std::vector<simulation::Event> events = simulation.events(next_);
  next_ = std::max(next_ + events.size(), count);
  return events;
}

void EventTopics::Welcome(const Topic& topic, const simulation::Simulation& simulation) {
  const std::vector<simulation::Event> past = simulation.events(0);
  std::vector<Hub::Message> messages;
  for (std::size_t i = past.size() - std::min(past.size(), topic.history); i < past.size(); ++i) {
    messages.push_back({base::NanosecondsOf(past[i].time), topic.encode(past[i])});
  }
  hub_->Welcome(topic.channel, messages);
}

}  // namespace gsv::gateway
