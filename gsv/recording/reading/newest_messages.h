// Finds the newest message of each channel at an instant of a recording.
#pragma once

#include <map>

#include "gsv/recording/mcap/mcap_reader.h"

namespace gsv::recording {

struct StoredMessage {
  base::SimTime log_time{};
  Bytes data;
};

struct NewestMessages {
  std::map<std::uint16_t, StoredMessage> by_channel;  // channels without a message are left out
  base::Problems problems;                            // blocks that could not be read
};

// Returns the newest message of each channel at or before `time`. Reads a block only if it may
// contain a newer message of a channel than the message that was found so far.
NewestMessages FindNewestMessages(const McapReader& reader, base::SimTime time);

}  // namespace gsv::recording
