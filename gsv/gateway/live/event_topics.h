// What happens to a simulation, live: /gsv/events, and the same for ROS's tools as a log, /rosout.
// Who comes late is told the newest of what has happened before.
//
// Threads  Publish() from one.
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

  // Publishes what has happened since the last call.
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
  std::uint64_t next_ = 0;  // the number of the first event that nobody was told of
};

}  // namespace gsv::gateway
