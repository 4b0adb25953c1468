// StatusTopics publishes the live topics of the simulation's status: /gsv/status at each change of
// a state and a few times per second, and /diagnostics for ROS tools once per second.
//
// A large status that differs only in times and counters is sent less often, so that these messages
// need at most kMaxStatusBytesPerSecond. The rate is at least kMinStatusRate.
//
// Threads  Publish() from one thread.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "gsv/gateway/foxglove/hub.h"
#include "gsv/gateway/live/pacing.h"
#include "gsv/simulation/simulation.h"

namespace gsv::gateway {

// The highest and the lowest rate of /gsv/status, in Hz of wall-clock time, and the limit on its
// bytes per second.
inline constexpr double kStatusRate = 5;
inline constexpr double kMinStatusRate = 0.5;
inline constexpr double kMaxStatusBytesPerSecond = 40'000;

// Publishes the live topics of the status.
class StatusTopics {
 public:
  // Advertises the topics.
  explicit StatusTopics(std::shared_ptr<Hub> hub);

  // Publishes the messages that are due, if there are subscribers.
  void Publish(const simulation::Simulation& simulation, WallTime now);

 private:
  // A topic, and its last message.
  struct Topic {
    foxglove::ChannelId channel = 0;
    SharedBytes (*encode)(const simulation::SimulationStatus& status) = nullptr;
    Pacing pacing;  // limits the rate of all messages
    // nullopt: the size does not limit the rate
    std::optional<double> max_bytes_per_second{};
    std::optional<simulation::Phase> phase{};  // the phase that was last published
    std::uint64_t states = 0;                  // hash of the states that were last published
    Pacing counters_pacing{pacing};            // limits the rate of messages without a new state
    Hub::Message latest{};                     // the last message, for new subscribers
  };
  static double RateFor(const Topic& topic, std::size_t size);  // Hz
  // Publishes the status on a topic if a message is due, or if there are new subscribers.
  void Publish(Topic& topic, const simulation::Simulation& simulation, WallTime now);

  const std::shared_ptr<Hub> hub_;
  std::vector<Topic> topics_;
};

}  // namespace gsv::gateway
