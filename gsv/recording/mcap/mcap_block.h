// The parts of a recording that hold its messages, read whole and checked.
//
// Input  hostile: sizes are checked before they are believed, and memory is bounded by Limits and
//        the file's own size.
#pragma once

#include <map>
#include <vector>

#include "gsv/base/error.h"
#include "gsv/recording/mcap/file_io.h"
#include "gsv/recording/mcap/mcap_records.h"

namespace gsv::recording {

struct Limits {
  // Of one chunk, uncompressed, and of any other record but attachments.
  std::uint64_t record_size = std::uint64_t{256} << 20;
  // Of the summary.
  std::uint64_t summary_size = std::uint64_t{1} << 30;
  // Of all chunks that overlap in time and must be open together to read messages in order.
  std::uint64_t open_blocks_size = std::uint64_t{1} << 30;
};

// A chunk, or messages that stand in the file without one.
struct MessageBlock {
  std::uint64_t offset = 0;  // of its first record
  std::uint64_t length = 0;
  bool is_chunk = true;
  std::uint64_t uncompressed_size = 0;
  base::SimTime start{};  // of the earliest message
  base::SimTime end{};    // of the latest
  // Those that have messages in it, ascending; empty: not known.
  std::vector<std::uint16_t> channels{};
};

using Channels = std::map<std::uint16_t, ChannelRecord>;

// The records of a block, uncompressed and checked.
[[nodiscard]] base::Result<Bytes> ReadRecords(const ByteSource& source, const MessageBlock& block,
                                              const Limits& limits);

// The messages among them, as they follow each other; they refer to `records`. kCorrupt if one
// belongs to no channel or is outside of the block's time.
[[nodiscard]] base::Result<std::vector<MessageRecord>> ListMessages(
    std::span<const std::byte> records, const MessageBlock& block, const Channels& channels);

struct BlockMessages {
  Bytes records;
  std::vector<MessageRecord> messages;  // refer to `records`
};
[[nodiscard]] base::Result<BlockMessages> ReadMessages(const ByteSource& source,
                                                       const MessageBlock& block,
                                                       const Channels& channels,
                                                       const Limits& limits);

}  // namespace gsv::recording
