#include "gsv/recording/mcap/chunk_builder.h"

#include <algorithm>

#include "gsv/base/check.h"

namespace gsv::recording {

void ChunkBuilder::Add(std::uint16_t channel, base::SimTime log_time,
                       std::span<const std::byte> record) {
  start_ = empty() ? log_time : std::min(start_, log_time);
  end_ = empty() ? log_time : std::max(end_, log_time);
  if (index_.size() <= channel) index_.resize(std::size_t{channel} + 1);
  MessageIndexRecord& index = index_[channel];
  if (index.entries.empty()) {
    index.channel_id = channel;
    channels_.push_back(channel);
  }
  index.entries.emplace_back(log_time, records_.size());
  PutBytes(records_, record);
}

const ChunkBuilder::Chunk& ChunkBuilder::Take(std::uint64_t offset) {
  GSV_CHECK(!empty());
  const std::span<const std::byte> compressed = compressor_.Compress(records_);
  chunk_.bytes.clear();
  chunk_.message_counts.clear();
  Append(chunk_.bytes, ChunkRecord{.start = start_,
                                   .end = end_,
                                   .uncompressed_size = records_.size(),
                                   .uncompressed_crc = Crc32(records_),
                                   .compression = "zstd",
                                   .records = compressed});
  ChunkIndexRecord& summary = chunk_.index;
  summary.start = start_;
  summary.end = end_;
  summary.chunk_offset = offset;
  summary.chunk_length = chunk_.bytes.size();
  summary.message_index_offsets.clear();
  std::sort(channels_.begin(), channels_.end());
  for (const std::uint16_t channel : channels_) {
    MessageIndexRecord& index = index_[channel];
    summary.message_index_offsets.emplace_back(channel, offset + chunk_.bytes.size());
    chunk_.message_counts.emplace_back(channel, index.entries.size());
    Append(chunk_.bytes, index);
    index.entries.clear();
  }
  summary.message_index_length = chunk_.bytes.size() - summary.chunk_length;
  summary.compression = "zstd";
  summary.compressed_size = compressed.size();
  summary.uncompressed_size = records_.size();
  records_.clear();
  channels_.clear();
  return chunk_;
}

}  // namespace gsv::recording
