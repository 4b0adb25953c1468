// How a simulation stands, live: /gsv/status, when its phase changes and a few times a second, and
// the same for ROS's tools once a second, /diagnostics.
//
// Threads  Publish() from one.
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

  // Publishes what is due, if somebody listens.
  void Publish(const simulation::Simulation& simulation, WallTime now);

 private:
  struct Topic {
    foxglove::ChannelId channel = 0;
    SharedBytes (*encode)(const simulation::SimulationStatus& status) = nullptr;
    Pacing pacing;
    std::optional<simulation::Phase> phase{};  // that was published
    Hub::Message latest{};
  };
  void Publish(Topic& topic, const simulation::Simulation& simulation, WallTime now);

  const std::shared_ptr<Hub> hub_;
  std::vector<Topic> topics_;
};

}  // namespace gsv::gateway
