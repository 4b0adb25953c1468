// Copies a truncated or damaged recording, or a part of a recording, to a complete one with an
// index.
#pragma once

#include <string>

#include "gsv/base/error.h"
#include "gsv/recording/mcap/mcap_reader.h"
#include "gsv/recording/reading/selection.h"

namespace gsv::recording {

// The number of recovered items, and the parts that were lost.
struct Recovery {
  std::uint64_t messages = 0;
  std::uint64_t attachments = 0;
  std::uint64_t metadata = 0;
  base::Problems problems;  // the parts that were lost, and where
};

// Copies all readable data to `sink`: complete attachments and metadata records, and the selected
// messages of complete chunks, in their order. If the selection begins after the start of the
// recording, messages of selected topics that are still valid (lasting_messages.h) come first;
// their log time is the begin of the selection. Returns only errors of writing.
[[nodiscard]] base::Result<Recovery> Recover(const McapReader& reader, ByteSink& sink,
                                             const Selection& selection = {});

// Recovers a file. `output` gets its name only when it is complete; an existing file is an
// error. If the input is a folder, the output is a folder (bag_folder.h) unless its name ends in
// .mcap.
[[nodiscard]] base::Result<Recovery> Recover(const std::string& input, const std::string& output,
                                             const Selection& selection = {},
                                             const Limits& limits = {});

// Returns a text such as "recovered 120 messages, 2 attachments, 1 metadata record", and a line for
// each problem.
std::string ToText(const Recovery& recovery);
std::string ToJson(const Recovery& recovery);

}  // namespace gsv::recording
