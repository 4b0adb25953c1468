#include "gsv/recording/mcap/chunk_builder.h"

#include <algorithm>
#include <optional>

#include "gsv/base/check.h"

namespace gsv::recording {

void ChunkBuilder::Add(const MessageRecord& message) {
  Index(message.channel_id, message.log_time, records_.size());
  Append(records_, message);
}

const ChunkBuilder::Chunk& ChunkBuilder::Take(std::uint64_t offset) {
  const Chunk& chunk = Encode(records_, offset);
  records_.clear();
  return chunk;
}

const ChunkBuilder::Chunk& ChunkBuilder::ChunkOf(std::span<const std::byte> records,
                                                 std::uint64_t offset) {
  GSV_CHECK(empty());
  std::span<const std::byte> rest = records;
  while (!rest.empty()) {
    const std::size_t position = records.size() - rest.size();
    const std::optional<RawRecord> record = TakeRecord(rest);
    GSV_CHECK(record && record->opcode == Opcode::kMessage);
    const MessageHead head = ReadMessageHead(record->content);
    Index(head.channel_id, head.log_time, position);
  }
  return Encode(records, offset);
}

void ChunkBuilder::Index(std::uint16_t channel, base::SimTime log_time, std::size_t position) {
  start_ = position == 0 ? log_time : std::min(start_, log_time);
  end_ = position == 0 ? log_time : std::max(end_, log_time);
  if (index_.size() <= channel) index_.resize(std::size_t{channel} + 1);
  index_[channel].channel_id = channel;
  index_[channel].entries.emplace_back(log_time, position);
}

const ChunkBuilder::Chunk& ChunkBuilder::Encode(std::span<const std::byte> records,
                                                std::uint64_t offset) {
  GSV_CHECK(!records.empty());
  const std::span<const std::byte> compressed = compressor_.Compress(records);
  chunk_.bytes.clear();
  chunk_.message_counts.clear();
  Append(chunk_.bytes, ChunkRecord{.start = start_,
                                   .end = end_,
                                   .uncompressed_size = records.size(),
                                   .uncompressed_crc = Crc32(records),
                                   .compression = "zstd",
                                   .records = compressed});
  ChunkIndexRecord& summary = chunk_.index;
  summary.start = start_;
  summary.end = end_;
  summary.chunk_offset = offset;
  summary.chunk_length = chunk_.bytes.size();
  summary.message_index_offsets.clear();
  for (MessageIndexRecord& index : index_) {
    if (index.entries.empty()) continue;
    summary.message_index_offsets.emplace_back(index.channel_id, offset + chunk_.bytes.size());
    chunk_.message_counts.emplace_back(index.channel_id, index.entries.size());
    Append(chunk_.bytes, index);
    index.entries.clear();
  }
  summary.message_index_length = chunk_.bytes.size() - summary.chunk_length;
  summary.compression = "zstd";
  summary.compressed_size = compressed.size();
  summary.uncompressed_size = records.size();
  records_.clear();
  return chunk_;
}

}  // namespace gsv::recording
