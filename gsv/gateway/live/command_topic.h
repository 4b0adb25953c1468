// What robots are told, live: /gsv/commands, a message for each robot whenever it is told something
// else.
//
// Bounded  so many messages a round; of a robot that was told more meanwhile, the newest.
// Threads  one.
#pragma once

#include <memory>
#include <vector>

#include "gsv/gateway/foxglove/hub.h"
#include "gsv/world/snapshot.h"

namespace gsv::gateway {

class CommandTopic {
 public:
  // Advertises the topic.
  explicit CommandTopic(std::shared_ptr<Hub> hub);

  // Publishes what is news in this snapshot, if anybody listens. Who listens anew is told how
  // things stand; the others hear it once more.
  void Publish(const world::Snapshot& snapshot);

 private:
  void FollowLayout(const world::Snapshot& snapshot);

  const std::shared_ptr<Hub> hub_;
  foxglove::ChannelId channel_ = 0;
  std::shared_ptr<const world::Layout> layout_;
  std::vector<world::DriveState> told_;  // by body of layout_
  std::size_t next_ = 0;                 // the body to begin with
};

}  // namespace gsv::gateway
