// A hash of the contents of a recording, independent of how it was written: equal for equal runs.
#pragma once

#include <string>

#include "gsv/recording/mcap/mcap_reader.h"

namespace gsv::recording {

// Whether its messages are hashed: they do not depend on the wall clock (see ChannelOptions).
[[nodiscard]] bool IsReproducible(const ChannelRecord& channel);

// Sixteen hexadecimal digits: a hash of (topic, type, time, number within the topic, bytes) of
// every message of reproducible channels.
//
// It is the sum of the hashes of messages, and so independent of chunks and of the order of topics
// at one instant. An unreadable chunk is an error.
[[nodiscard]] base::Result<std::string> ContentHash(const McapReader& reader);

}  // namespace gsv::recording
