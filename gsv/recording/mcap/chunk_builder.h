// Gathers messages until they are worth compressing, and keeps an index of them.
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
  std::size_t size() const { return records_.size(); }  // before compression

  // A chunk's record and the message index records that follow it, and what the summary says of
  // them. Offsets count from the chunk's beginning.
  struct Chunk {
    Bytes bytes;
    ChunkIndexRecord index;
    std::map<std::uint16_t, std::uint64_t> message_counts;  // by channel
  };
  // The messages gathered so far; none are left. There must be some.
  Chunk Take();

 private:
  ZstdCompressor compressor_;
  Bytes records_;
  std::map<std::uint16_t, MessageIndexRecord> index_;
  base::SimTime start_{};
  base::SimTime end_{};
};

}  // namespace gsv::recording
