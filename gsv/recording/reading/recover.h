// Makes a complete, indexed recording of one that was cut off or damaged, or of part of one.
#pragma once

#include <string>

#include "gsv/base/error.h"
#include "gsv/recording/mcap/mcap_reader.h"
#include "gsv/recording/reading/selection.h"

namespace gsv::recording {

struct Recovery {
  std::uint64_t messages = 0;
  std::uint64_t attachments = 0;
  std::uint64_t metadata = 0;
  base::Problems problems;  // what was lost, and where
};

// Copies all that can be read to `sink`: every chunk, attachment and metadata record that is
// whole, and of the messages those that are selected. They keep their order. Where the selection
// begins after the recording does, the messages of selected topics that still hold then
// (lasting_messages.h) come first, logged at that instant. An error is one of writing.
[[nodiscard]] base::Result<Recovery> Recover(const McapReader& reader, ByteSink& sink,
                                             const Selection& selection = {});

// The same for files. `output` appears only when it is complete; one that is there is an error. From
// a recording's folder it is a folder, too (bag_folder.h), unless its name ends in .mcap.
[[nodiscard]] base::Result<Recovery> Recover(const std::string& input, const std::string& output,
                                             const Selection& selection = {},
                                             const Limits& limits = {});

// "recovered 120 messages, 2 attachments, 1 metadata record" and a line for each problem.
std::string ToText(const Recovery& recovery);
std::string ToJson(const Recovery& recovery);

}  // namespace gsv::recording
