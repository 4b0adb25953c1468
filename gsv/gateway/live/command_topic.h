// CommandTopic publishes the live topic /gsv/commands: a message when the drive command of a robot
// changes.
//
// Bounded  the number of messages per call of Publish(). If a robot's command changes several times
//          between two messages about this robot, only the newest command is sent.
// Threads  Publish() from one thread.
#pragma once

#include <memory>
#include <vector>

#include "gsv/gateway/foxglove/hub.h"
#include "gsv/world/snapshot.h"

namespace gsv::gateway {

// Publishes the live topic /gsv/commands.
class CommandTopic {
 public:
  // Advertises the topic.
  explicit CommandTopic(std::shared_ptr<Hub> hub);

  // Publishes changes in this snapshot, if there are subscribers. If a subscriber is new, all
  // commands are sent to all subscribers again.
  void Publish(const world::Snapshot& snapshot);

 private:
  // Stores the layout of the snapshot, and forgets the commands that were sent.
  void FollowLayout(const world::Snapshot& snapshot);

  const std::shared_ptr<Hub> hub_;
  foxglove::ChannelId channel_ = 0;
  std::shared_ptr<const world::Layout> layout_;
  std::vector<world::DriveState> sent_;  // the command that was last sent, for each body of layout_
  std::size_t next_ = 0;                 // index of the body at which the next Publish() begins
};

}  // namespace gsv::gateway
