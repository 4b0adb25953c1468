// A hash of the contents of a recording. The hash does not depend on how the recording was written,
// and is equal for equal runs.
#pragma once

#include <string>

#include "gsv/recording/mcap/mcap_reader.h"

namespace gsv::recording {

// Whether the channel's messages are hashed, because they do not depend on the wall clock (see
// ChannelOptions).
[[nodiscard]] bool IsReproducible(const ChannelRecord& channel);

// Returns sixteen hexadecimal digits: a hash of all messages of reproducible channels. For each
// message, it covers topic, type, time, number within the topic, and bytes.
//
// The hash is the sum of the hashes of the messages, so it does not depend on chunks, nor on the
// order of topics at one instant. Fails if a chunk cannot be read.
[[nodiscard]] base::Result<std::string> ContentHash(const McapReader& reader);

}  // namespace gsv::recording
