// StepCostTopic publishes the live topic /gsv/step_costs: the wall-clock time of each part of the
// steps, and the behaviours that delay the steps.
//
// Steps are timed only while there are subscribers.
//
// Bounded  the number of single steps in a message, and the number of behaviours.
// Threads  Publish() from one thread.
#pragma once

#include <memory>

#include "gsv/gateway/foxglove/hub.h"
#include "gsv/gateway/live/pacing.h"
#include "gsv/messages/gsv_msgs.h"
#include "gsv/simulation/simulation.h"

namespace gsv::gateway {

// Maximum numbers of behaviours that delay steps, and of single steps, in a message.
inline constexpr std::size_t kMaxHoldUps = 64;
inline constexpr std::size_t kMaxLongestSteps = 32;

// Publishes the live topic /gsv/step_costs.
class StepCostTopic {
 public:
  // Advertises the topic.
  explicit StepCostTopic(std::shared_ptr<Hub> hub);

  // Publishes the costs since the last message, twice per second, if there were steps.
  void Publish(simulation::Simulation& simulation, WallTime now);

 private:
  // Collects the times of steps on the stepping thread.
  class Watch;

  const std::shared_ptr<Hub> hub_;
  foxglove::ChannelId channel_ = 0;
  Pacing pacing_;                 // limits the rate of messages
  std::shared_ptr<Watch> watch_;  // set while there are subscribers
};

}  // namespace gsv::gateway
