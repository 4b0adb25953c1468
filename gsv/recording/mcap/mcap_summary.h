// The contents of a recording and their places in the file. They come from its summary or, if it
// has no valid one, from a scan of the file.
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
  std::vector<MessageBlock> blocks;  // ordered by offset; none overlaps another in the file
  std::vector<AttachmentIndexRecord> attachments;
  std::vector<MetadataIndexRecord> metadata;
  std::map<std::uint16_t, std::uint64_t> message_counts;  // number of messages by channel
  std::uint64_t message_count = 0;
  base::SimTime start{};    // time of the earliest message
  base::SimTime end{};      // time of the latest message
  bool indexed = false;     // whether this came from the file's own summary
  base::Problems problems;  // the missing or damaged parts
};

// Returns kCorrupt if the file is not an MCAP file. Damage after its start is listed in `problems`.
[[nodiscard]] base::Result<Summary> LoadSummary(const ByteSource& source, const Limits& limits);

// Like LoadSummary(), but reads every record and ignores the file's own summary.
[[nodiscard]] base::Result<Summary> ScanForSummary(const ByteSource& source, const Limits& limits);

}  // namespace gsv::recording
