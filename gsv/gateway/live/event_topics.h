// The live topics of events: /gsv/events, and /rosout as a log for ROS tools. New subscribers get
// the newest earlier events.
//
// Threads  Publish() from one thread.
#pragma once

#include <memory>
#include <vector>

#include "gsv/gateway/foxglove/hub.h"
#include "gsv/simulation/simulation.h"

namespace gsv::gateway {

class EventTopics {
 public:
  // Advertises the topics.
  explicit EventTopics(std::shared_ptr<Hub> hub);

  // Publishes the events since the last call.
  void Publish(const simulation::Simulation& simulation);

 private:
  struct Topic {
    foxglove::ChannelId channel = 0;
    std::size_t history = 0;
    SharedBytes (*encode)(const simulation::Event& event) = nullptr;
  };
  std::vector<simulation::Event> TakeNew(const simulation::Simulation& simulation);
  void Welcome(const Topic& topic, const simulation::Simulation& simulation);

  const std::shared_ptr<Hub> hub_;
  std::vector<Topic> topics_;
  std::uint64_t next_ = 0;  // number of the first unpublished event
};

}  // namespace gsv::gateway
