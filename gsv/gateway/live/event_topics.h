// EventTopics publishes the live topics of events: /gsv/events, /rosout as a log for ROS tools,
// /gsv/notes with the notes of viewers, and /gsv/output with the lines that behaviours' programs
// print. New subscribers get the newest earlier events.
//
// Threads  Publish() from one thread.
#pragma once

#include <memory>
#include <vector>

#include "gsv/gateway/foxglove/hub.h"
#include "gsv/simulation/simulation.h"

namespace gsv::gateway {

// Publishes the live topics of events, notes and output.
class EventTopics {
 public:
  // Advertises the topics.
  explicit EventTopics(std::shared_ptr<Hub> hub);

  // Publishes the events and the output since the last call.
  void Publish(const simulation::Simulation& simulation);

 private:
  // A topic, and the form of its messages.
  struct Topic {
    foxglove::ChannelId channel = 0;
    std::size_t history = 0;  // number of earlier events that a new subscriber gets
    // Returns the message of an event.
    SharedBytes (*encode)(const simulation::Event& event) = nullptr;
    bool has_notes = false;  // whether the topic has only the notes
  };
  // Events or output, and the topics that publish them.
  struct Source {
    // Simulation::events() or outputs(), and the member of the status that has their number.
    std::vector<simulation::Event> (simulation::Simulation::*since)(std::uint64_t first) const;
    std::uint64_t simulation::SimulationStatus::*count;
    std::vector<Topic> topics;
    std::uint64_t next = 0;  // number of the next event to publish
  };
  // Returns the events since the last call.
  static std::vector<simulation::Event> TakeNew(const simulation::Simulation& simulation,
                                                Source& source);
  // Publishes the new events of a source on its topics.
  void Publish(const simulation::Simulation& simulation, Source& source);
  // Sends the newest earlier events to new subscribers of the topic.
  void Welcome(const Topic& topic, const std::vector<simulation::Event>& past);

  const std::shared_ptr<Hub> hub_;
  Source events_, output_;
};

}  // namespace gsv::gateway
