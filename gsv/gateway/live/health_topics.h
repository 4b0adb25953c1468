// HealthTopics publishes the live topics /gsv/health and /gsv/expectations: at each change, at most
// twice per second, and only if there are subscribers.
//
// Threads  Publish() from one thread.
#pragma once

#include <memory>
#include <optional>

#include "gsv/gateway/foxglove/hub.h"
#include "gsv/gateway/live/pacing.h"
#include "gsv/health/health_tracker.h"
#include "gsv/messages/gsv_msgs.h"
#include "gsv/simulation/simulation.h"

namespace gsv::gateway {

// Publishes the live topics /gsv/health and /gsv/expectations.
class HealthTopics {
 public:
  // Advertises the topics.
  explicit HealthTopics(std::shared_ptr<Hub> hub);

  // Publishes the messages that are due.
  void Publish(simulation::Simulation& simulation, WallTime now);

 private:
  // A topic, and its last message.
  struct Topic {
    foxglove::ChannelId channel = 0;
    Pacing pacing;                         // limits the rate of the topic's messages
    std::optional<Hub::Message> latest{};  // the last message, for new subscribers
  };
  // Whether the topic needs a message now.
  bool IsDue(const Topic& topic, WallTime now) const;
  void PublishHealth(simulation::Simulation& simulation, WallTime now);
  void PublishExpectations(const simulation::Simulation& simulation, WallTime now);
  // Sends to all subscribers if `is_news`, otherwise only to new subscribers.
  void Send(Topic& topic, bool is_news, base::SimTime time, SharedBytes payload, WallTime now);

  const std::shared_ptr<Hub> hub_;
  Topic health_, expectations_;
  health::HealthTracker tracker_;
  messages::gsv_msgs::Health health_sent_;  // the messages that were published last
  messages::gsv_msgs::Expectations expectations_sent_;
};

}  // namespace gsv::gateway
