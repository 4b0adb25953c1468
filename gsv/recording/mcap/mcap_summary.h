// What a recording holds and where, taken from its summary or, if it has none that can be
// trusted, found by reading all of it.
//
// Input  hostile, see mcap_block.h.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "gsv/base/error.h"
#include "gsv/recording/mcap/file_io.h"
#include "gsv/recording/mcap/mcap_block.h"
#include "gsv/recording/mcap/mcap_records.h"

namespace gsv::recording {

struct Summary {
  std::string profile;
  std::string library;
  std::map<std::uint16_t, SchemaRecord> schemas;
  Channels channels;
  std::vector<MessageBlock> blocks;  // by offset; none overlaps another in the file
  std::vector<AttachmentIndexRecord> attachments;
  std::vector<MetadataIndexRecord> metadata;
  std::map<std::uint16_t, std::uint64_t> message_counts;  // by channel
  std::uint64_t message_count = 0;
  base::SimTime start{};    // of the earliest message
  base::SimTime end{};      // of the latest
  bool indexed = false;     // it came from the file's own summary
  base::Problems problems;  // what is missing or damaged
};

// kCorrupt if it is no MCAP file at all; damage further on is told in `problems`.
[[nodiscard]] base::Result<Summary> LoadSummary(const ByteSource& source, const Limits& limits);

// The same by reading every record, whatever the file's own summary says.
[[nodiscard]] base::Result<Summary> ScanForSummary(const ByteSource& source, const Limits& limits);

}  // namespace gsv::recording
