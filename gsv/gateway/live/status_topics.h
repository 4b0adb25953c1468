// The live topics of the status: /gsv/status at each change of the phase and a few times per
// second, and /diagnostics for ROS tools once per second.
//
// Threads  Publish() from one thread.
#pragma once

#include <memory>
#include <optional>

#include "gsv/gateway/foxglove/hub.h"
#include "gsv/gateway/live/pacing.h"
#include "gsv/simulation/simulation.h"

namespace gsv::gateway {

class StatusTopics {
 public:
  // Advertises the topics.
  explicit StatusTopics(std::shared_ptr<Hub> hub);

  // Publishes the messages that are due, if there are subscribers.
  void Publish(const simulation::Simulation& simulation, WallTime now);

 private:
  struct Topic {
    foxglove::ChannelId channel = 0;
    SharedBytes (*encode)(const simulation::SimulationStatus& status) = nullptr;
    Pacing pacing;
    std::optional<simulation::Phase> phase{};  // the phase that was last published
    Hub::Message latest{};
  };
  void Publish(Topic& topic, const simulation::Simulation& simulation, WallTime now);

  const std::shared_ptr<Hub> hub_;
  std::vector<Topic> topics_;
};

}  // namespace gsv::gateway
