// Who meets whom, live: /gsv/contacts, a message at each step at which two bodies do.
//
// Viewers are told a few times a second and bodies meet between: while somebody listens, the
// stepping thread keeps what met.
//
// Bounded  of one round's the newest so many.
// Threads  Publish() from one.
#pragma once

#include <memory>

#include "gsv/gateway/hub.h"
#include "gsv/simulation/simulation.h"

namespace gsv::gateway {

class ContactTopic {
 public:
  // Advertises the topic.
  explicit ContactTopic(std::shared_ptr<Hub> hub);
  ~ContactTopic();

  // Publishes what met since the last call, if anybody listens.
  void Publish(simulation::Simulation& simulation);

 private:
  class Watch;

  const std::shared_ptr<Hub> hub_;
  foxglove::ChannelId channel_ = 0;
  std::shared_ptr<Watch> watch_;  // while somebody listens
};

}  // namespace gsv::gateway
