#include "gsv/gateway/live/event_topics.h"

#include <algorithm>
#include <utility>

#include "gsv/gateway/foxglove/channels.h"
#include "gsv/presentation/notes.h"
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

SharedBytes EncodedNote(const simulation::Event& event) {
  return Encoded(presentation::NoteMessage(event));
}

}  // namespace

EventTopics::EventTopics(std::shared_ptr<Hub> hub) : hub_(std::move(hub)) {
  const auto channels = hub_->Advertise({ChannelFor(topics::kEvents), ChannelFor(topics::kLog),
                                         ChannelFor(topics::kOutput), ChannelFor(topics::kNotes)});
  const auto history = [](const char* topic) { return presentation::FindTopic(topic)->history; };
  using simulation::Simulation;
  using simulation::SimulationStatus;
  events_ = {&Simulation::events,
             &SimulationStatus::events,
             {{channels[0], history(topics::kEvents.name), EncodedEvent},
              {channels[1], history(topics::kLog.name), EncodedLog},
              {channels[3], history(topics::kNotes.name), EncodedNote, true}}};
  output_ = {&Simulation::outputs,
             &SimulationStatus::outputs,
             {{channels[2], history(topics::kOutput.name), EncodedLog}}};
}

void EventTopics::Publish(const simulation::Simulation& simulation) {
  Publish(simulation, events_);
  Publish(simulation, output_);
}

void EventTopics::Publish(const simulation::Simulation& simulation, Source& source) {
  for (const simulation::Event& event : TakeNew(simulation, source)) {
    for (const Topic& topic : source.topics) {
      if (topic.has_notes != presentation::IsNote(event)) continue;
      if (!hub_->IsSubscribed(topic.channel)) continue;
      hub_->Publish(topic.channel, {base::NanosecondsOf(event.time), topic.encode(event)},
                    Hub::Audience::kEstablished);
    }
  }
  for (const Topic& topic : source.topics) {
    if (hub_->HasNewSubscribers(topic.channel)) Welcome(topic, (simulation.*source.since)(0));
  }
}

std::vector<simulation::Event> EventTopics::TakeNew(const simulation::Simulation& simulation,
                                                    Source& source) {
  if ((simulation.*source.since)(source.next).empty()) return {};
  // `count` is the number of all events so far, including old events that the simulation has
  // dropped. The code reads `count` before `events`. So an event that is counted but is not in
  // `events` was dropped, and the next call need not look for it.
  const std::uint64_t count = simulation.status().*source.count;
  std::vector<simulation::Event> events = (simulation.*source.since)(source.next);
  source.next = std::max(source.next + events.size(), count);
  return events;
}

void EventTopics::Welcome(const Topic& topic, const std::vector<simulation::Event>& past) {
  std::vector<Hub::Message> messages;  // the newest first
  for (auto event = past.rbegin(); event != past.rend(); ++event) {
    if (messages.size() == topic.history) break;
    if (topic.has_notes != presentation::IsNote(*event)) continue;
    messages.push_back({base::NanosecondsOf(event->time), topic.encode(*event)});
  }
  std::reverse(messages.begin(), messages.end());
  hub_->Welcome(topic.channel, messages);
}

}  // namespace gsv::gateway
