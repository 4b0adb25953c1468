// The contents of a recording and their positions, from its summary or, without a valid one, by
// scanning the file.
//
// Input  untrusted, see mcap_block.h.
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
  bool indexed = false;     // whether it came from the file's own summary
  base::Problems problems;  // missing or damaged parts
};

// kCorrupt if it is not an MCAP file; later damage is listed in `problems`.
[[nodiscard]] base::Result<Summary> LoadSummary(const ByteSource& source, const Limits& limits);

// The same by reading every record, ignoring the file's own summary.
[[nodiscard]] base::Result<Summary> ScanForSummary(const ByteSource& source, const Limits& limits);

}  // namespace gsv::recording
