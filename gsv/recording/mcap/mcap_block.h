// Reads and checks the parts of a recording that contain its messages.
//
// Input  untrusted. Sizes are checked before use, and memory is limited by Limits and by the size
//        of the file.
#pragma once

#include <map>
#include <vector>

#include "gsv/base/error.h"
#include "gsv/recording/mcap/file_io.h"
#include "gsv/recording/mcap/mcap_records.h"

namespace gsv::recording {

// Limits that protect the reader from damaged or malicious files, in bytes.
struct Limits {
  // Maximum size of one uncompressed chunk, and of any other record except attachments.
  std::uint64_t record_size = std::uint64_t{256} << 20;
  // Maximum size of the summary.
  std::uint64_t summary_size = std::uint64_t{1} << 30;
  // Maximum size of all chunks that overlap in time and must be open together to read messages in
  // order.
  std::uint64_t open_blocks_size = std::uint64_t{1} << 30;
};

// A chunk, or a sequence of messages that are outside of chunks.
struct MessageBlock {
  std::uint64_t offset = 0;  // offset of the block's first record in the file
  std::uint64_t length = 0;  // number of bytes of the block in the file
  bool is_chunk = true;      // false for messages outside of chunks
  std::uint64_t uncompressed_size = 0;
  base::SimTime start{};  // time of the earliest message
  base::SimTime end{};    // time of the latest message
  // The channels with messages in the block, in ascending order; empty if they are unknown.
  std::vector<std::uint16_t> channels{};
};

using Channels = std::map<std::uint16_t, ChannelRecord>;

// Returns the records of a block, uncompressed and checked.
[[nodiscard]] base::Result<Bytes> ReadRecords(const ByteSource& source, const MessageBlock& block,
                                              const Limits& limits);

// Returns the messages in `records`, in their order. They refer to the bytes of `records`. Returns
// kCorrupt if a message has no channel, or is outside the time range of the block.
[[nodiscard]] base::Result<std::vector<MessageRecord>> ListMessages(
    std::span<const std::byte> records, const MessageBlock& block, const Channels& channels);

// The records of a block, and the messages in them.
struct BlockMessages {
  Bytes records;
  std::vector<MessageRecord> messages;  // refer to the bytes of `records`
};
[[nodiscard]] base::Result<BlockMessages> ReadMessages(const ByteSource& source,
                                                       const MessageBlock& block,
                                                       const Channels& channels,
                                                       const Limits& limits);

}  // namespace gsv::recording
