// Collects messages, and makes a chunk with a message index of them.
#pragma once

#include <map>

#include "gsv/recording/mcap/compression.h"
#include "gsv/recording/mcap/mcap_records.h"

namespace gsv::recording {

class ChunkBuilder {
 public:
  explicit ChunkBuilder(int compression_level) : compressor_(compression_level) {}

  void Add(const MessageRecord& message);

  bool empty() const { return index_.empty(); }
  std::size_t size() const {
    return records_.size();
  }  // Size of the collected messages before
     // compression.

  // A chunk record and its message index records, as bytes, and their data for the summary. Offsets
  // are counted from the start of the chunk.
  struct Chunk {
    Bytes bytes;
    ChunkIndexRecord index;
    std::map<std::uint16_t, std::uint64_t> message_counts;  // number of messages by channel
  };
  // Returns the collected messages as a chunk, and clears them. There must be at least one
  // message.
  Chunk Take();

 private:
  ZstdCompressor compressor_;
  Bytes records_;
  std::map<std::uint16_t, MessageIndexRecord> index_;
  base::SimTime start_{};
  base::SimTime end_{};
};

}  // namespace gsv::recording
