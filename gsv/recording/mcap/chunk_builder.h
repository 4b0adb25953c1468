// Collects messages into a chunk of an MCAP file, and makes the chunk's message index.
#pragma once

#include <utility>
#include <vector>

#include "gsv/recording/mcap/compression.h"
#include "gsv/recording/mcap/mcap_records.h"

namespace gsv::recording {

class ChunkBuilder {
 public:
  explicit ChunkBuilder(int compression_level) : compressor_(compression_level) {}

  // Adds a message.
  void Add(const MessageRecord& message);

  bool empty() const { return records_.empty(); }
  // Returns the size of the collected messages before compression.
  std::size_t size() const { return records_.size(); }

  // An encoded chunk with its message index records, and the data about the chunk in the file's
  // summary.
  struct Chunk {
    Bytes bytes;
    ChunkIndexRecord index;
    // The channels of the chunk, in ascending order, and the number of messages of each.
    std::vector<std::pair<std::uint16_t, std::uint64_t>> message_counts;
  };
  // Returns the collected messages as a chunk at `offset` of the file, and clears them. There must
  // be at least one message. The chunk stays valid until the next call.
  const Chunk& Take(std::uint64_t offset);
  // Returns the messages in `records` as a chunk at `offset` of the file. `records` contains at
  // least one complete record, and nothing but messages. No messages may be collected. The chunk
  // stays valid until the next call.
  const Chunk& ChunkOf(std::span<const std::byte> records, std::uint64_t offset);

 private:
  // Adds a message to the index. `position` is the position of its record in the chunk.
  void Index(std::uint16_t channel, base::SimTime log_time, std::size_t position);
  // Returns a chunk of these records, which are indexed, and clears the index.
  const Chunk& Encode(std::span<const std::byte> records, std::uint64_t offset);

  ZstdCompressor compressor_;
  Bytes records_;  // the collected records, not compressed
  // The message index of each channel; empty for channels without messages in the chunk.
  std::vector<MessageIndexRecord> index_;
  // Times of the earliest and of the latest collected message.
  base::SimTime start_{};
  base::SimTime end_{};
  Chunk chunk_;  // the last chunk; its memory is reused
};

}  // namespace gsv::recording
