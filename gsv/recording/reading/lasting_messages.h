// Finds messages that stay valid until the next message of their kind: transforms of sensors, the
// last command of a robot, edits of the world. An excerpt of a recording must begin with the
// messages that were recorded before the excerpt's start and are still valid at its start.
#pragma once

#include <vector>

#include "gsv/recording/mcap/mcap_reader.h"
#include "gsv/recording/reading/newest_messages.h"

namespace gsv::recording {

// Which messages of a topic stay valid after their instant.
enum class Lasting {
  kNo,      // messages apply to their instant only
  kNewest,  // the newest message of the topic stays valid
  kOfEach,  // the newest message of each robot or actuator stays valid
  kAll,     // all messages stay valid
};

// Returns which messages of a channel stay valid. GSV's topics are known by name. In recordings of
// other programs, messages stay valid on topics with the durability transient_local (rosbag2's
// offered_qos_profiles; latching in ROS 1), on any tf_static, and on topics that have a single
// message.
Lasting LastingOf(const Summary& summary, const ChannelRecord& channel);

struct LastingMessage {
  std::uint16_t channel_id = 0;
  std::uint32_t sequence = 0;
  base::SimTime publish_time{};
  Bytes data;
};

struct LastingMessages {
  std::vector<LastingMessage> messages;  // in the order of the file
  base::Problems problems;               // blocks that could not be read
};

// Returns the messages from before `time` that are still valid at `time`.
LastingMessages FindLastingMessages(const McapReader& reader, base::SimTime time);

}  // namespace gsv::recording
