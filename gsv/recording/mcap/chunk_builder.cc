#include "gsv/recording/mcap/chunk_builder.h"

#include <algorithm>

#include "gsv/base/check.h"

namespace gsv::recording {

void ChunkBuilder::Add(const MessageRecord& message) {
  start_ = empty() ? message.log_time : std::min(start_, message.log_time);
  end_ = empty() ? message.log_time : std::max(end_, message.log_time);
  MessageIndexRecord& index = index_[message.channel_id];
  index.channel_id = message.channel_id;
  index.entries.emplace_back(message.log_time, records_.size());
  Append(records_, message);
}

ChunkBuilder::Chunk ChunkBuilder::Take() {
  GSV_CHECK(!empty());
  const Bytes compressed = compressor_.Compress(records_);
  Chunk chunk;
  Append(chunk.bytes, ChunkRecord{.start = start_,
                                  .end = end_,
                                  .uncompressed_size = records_.size(),
                                  .uncompressed_crc = Crc32(records_),
                                  .compression = "zstd",
                                  .records = compressed});
  chunk.index.start = start_;
  chunk.index.end = end_;
  chunk.index.chunk_length = chunk.bytes.size();
  for (const auto& [channel, index] : index_) {
    chunk.index.message_index_offsets[channel] = chunk.bytes.size();
    chunk.message_counts[channel] = index.entries.size();
    Append(chunk.bytes, index);
  }
  chunk.index.message_index_length = chunk.bytes.size() - chunk.index.chunk_length;
  chunk.index.compression = "zstd";
  chunk.index.compressed_size = compressed.size();
  chunk.index.uncompressed_size = records_.size();
  records_.clear();
  index_.clear();
  return chunk;
}

}  // namespace gsv::recording
