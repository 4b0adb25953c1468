// The state at an instant of a recording: the newest message of each channel.
#pragma once

#include <map>

#include "gsv/recording/mcap/mcap_reader.h"

namespace gsv::recording {

struct StoredMessage {
  base::SimTime log_time{};
  Bytes data;
};

struct NewestMessages {
  std::map<std::uint16_t, StoredMessage> by_channel;  // only channels that have a message
  base::Problems problems;                            // blocks that cannot be read
};

// Returns the newest message of each channel that is not after `time`. Reads no more blocks than
// the channels require.
NewestMessages FindNewestMessages(const McapReader& reader, base::SimTime time);

}  // namespace gsv::recording
