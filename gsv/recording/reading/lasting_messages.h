// Messages that stay valid until the next one of their kind: transforms of sensors, the last
// command of a robot, edits of the world. An excerpt of a recording needs those from before its
// start.
#pragma once

#include <vector>

#include "gsv/recording/mcap/mcap_reader.h"
#include "gsv/recording/reading/newest_messages.h"

namespace gsv::recording {

enum class Lasting {
  kNo,      // not valid later
  kNewest,  // the newest of the topic is valid
  kOfEach,  // the newest of each robot, or of each actuator, is valid
  kAll,     // all are valid
};

// The messages of a channel that stay valid. GSV's topics are known by name. In recordings of other
// programs these are: topics with the durability transient_local (rosbag2's offered_qos_profiles;
// latching in ROS 1), any tf_static, and topics with a single message in the whole recording.
Lasting LastingOf(const Summary& summary, const ChannelRecord& channel);

struct LastingMessage {
  std::uint16_t channel_id = 0;
  std::uint32_t sequence = 0;
  base::SimTime publish_time{};
  Bytes data;
};

struct LastingMessages {
  std::vector<LastingMessage> messages;  // in the order of the file
  base::Problems problems;               // blocks that cannot be read
};

// The messages from before `time` that are still valid at `time`.
LastingMessages FindLastingMessages(const McapReader& reader, base::SimTime time);

}  // namespace gsv::recording
