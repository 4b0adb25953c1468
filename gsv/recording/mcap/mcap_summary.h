// Lists what a recording contains, and where. The list comes from the file's summary or, if that is
// not valid, from a scan of the file.
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

// The contents of a recording: its channels, and where its messages and attachments are.
struct Summary {
  std::string profile;
  std::string library;
  std::map<std::uint16_t, SchemaRecord> schemas;
  Channels channels;
  std::vector<MessageBlock> blocks;  // ordered by offset; blocks do not overlap in the file
  std::vector<AttachmentIndexRecord> attachments;
  std::vector<MetadataIndexRecord> metadata;
  std::map<std::uint16_t, std::uint64_t> message_counts;  // number of messages by channel
  std::uint64_t message_count = 0;
  base::SimTime start{};    // time of the earliest message
  base::SimTime end{};      // time of the latest message
  bool indexed = false;     // whether the list came from the file's summary
  base::Problems problems;  // missing or damaged parts
};

// Fails with kCorrupt if the file is not an MCAP file. Damage after its start is listed in
// `problems`.
[[nodiscard]] base::Result<Summary> LoadSummary(const ByteSource& source, const Limits& limits);

// Makes the list from every record, and ignores the file's own summary.
[[nodiscard]] base::Result<Summary> ScanForSummary(const ByteSource& source, const Limits& limits);

}  // namespace gsv::recording
