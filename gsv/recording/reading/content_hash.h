// What a recording says, apart from how it was written: equal for two runs that went alike.
#pragma once

#include <string>

#include "gsv/recording/mcap/mcap_reader.h"

namespace gsv::recording {

// Whether its messages count: they do not tell of the wall clock (see ChannelOptions).
[[nodiscard]] bool IsReproducible(const ChannelRecord& channel);

// Sixteen hexadecimal digits over (topic, type, time, number within the topic, bytes) of every
// message of the channels that count.
//
// The hashes of the messages are added up, so that neither the limits of chunks nor the order in
// which the topics of one instant were written matter. An unreadable chunk is an error.
[[nodiscard]] base::Result<std::string> ContentHash(const McapReader& reader);

}  // namespace gsv::recording
