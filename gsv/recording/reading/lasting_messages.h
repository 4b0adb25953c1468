// Messages that hold until the next one of their kind, however long that takes: where sensors sit,
// the last command of a robot, the edits of the world. A part of a recording needs those from
// before its start.
#pragma once

#include <vector>

#include "gsv/recording/mcap/mcap_reader.h"
#include "gsv/recording/reading/newest_messages.h"

namespace gsv::recording {

enum class Lasting {
  kNo,      // of no use later
  kNewest,  // the newest of the topic holds
  kOfEach,  // the newest of each robot, or of each actuator of a robot, holds
  kAll,     // each adds to those before it
};

// Which messages of a channel hold. Topics of GSV are known by their names. Of other programs' recordings
// these hold: topics whose publisher keeps them for late subscribers (durability transient_local in
// rosbag2's offered_qos_profiles, latching in ROS 1), any tf_static, and topics with a single
// message in the whole recording.
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

// Those that still hold at `time` of what was recorded before it.
LastingMessages FindLastingMessages(const McapReader& reader, base::SimTime time);

}  // namespace gsv::recording
