#include "gsv/recording/mcap/mcap_block.h"

#include "gsv/recording/mcap/compression.h"

namespace gsv::recording {
namespace {

using base::ErrorCode;

base::Failure<base::Error> Damaged(const MessageBlock& block, const std::string& what) {
  return base::Fail(ErrorCode::kCorrupt, "a chunk is damaged: " + what,
                    "byte " + std::to_string(block.offset));
}

base::Result<Bytes> Uncompress(const MessageBlock& block, const ChunkRecord& chunk) {
  if (chunk.compression == "zstd") {
    base::Result<Bytes> records = ZstdDecompress(chunk.records, chunk.uncompressed_size);
    if (!records) return Damaged(block, records.error().message);
    return records;
  }
  if (!chunk.compression.empty()) {
    return base::Fail(ErrorCode::kInvalidArgument,
                      "expected a chunk compressed with zstd or not at all, found '" +
                          chunk.compression + "'; convert the recording with the mcap tool",
                      "byte " + std::to_string(block.offset));
  }
  return Bytes(chunk.records.begin(), chunk.records.end());
}

}  // namespace

base::Result<Bytes> ReadRecords(const ByteSource& source, const MessageBlock& block,
                                const Limits& limits) {
  if (block.length > limits.record_size || block.uncompressed_size > limits.record_size) {
    return base::Fail(ErrorCode::kInvalidArgument,
                      "expected chunks of at most " + std::to_string(limits.record_size) +
                          " bytes, found a larger one",
                      "byte " + std::to_string(block.offset));
  }
  base::Result<Bytes> bytes = source.Read(block.offset, block.length);
  if (!bytes || !block.is_chunk) return bytes;

  std::span<const std::byte> rest = *bytes;
  const std::optional<RawRecord> record = TakeRecord(rest);
  if (!record || record->opcode != Opcode::kChunk || !rest.empty()) {
    return Damaged(block, "there is no chunk at the position in the index");
  }
  const auto chunk = Parse<ChunkRecord>(record->content);
  if (!chunk || chunk->uncompressed_size != block.uncompressed_size ||
      chunk->start != block.start || chunk->end != block.end) {
    return Damaged(block, "its header does not match the index");
  }
  base::Result<Bytes> records = Uncompress(block, *chunk);
  if (!records) return records;
  if (records->size() != chunk->uncompressed_size) return Damaged(block, "its size is wrong");
  if (chunk->uncompressed_crc != 0 && Crc32(*records) != chunk->uncompressed_crc) {
    return Damaged(block, "its checksum is wrong");
  }
  return records;
}

base::Result<std::vector<MessageRecord>> ListMessages(std::span<const std::byte> records,
                                                      const MessageBlock& block,
                                                      const Channels& channels) {
  std::vector<MessageRecord> messages;
  while (!records.empty()) {
    const std::optional<RawRecord> record = TakeRecord(records);
    if (!record) return Damaged(block, "it ends in the middle of a record");
    if (record->opcode != Opcode::kMessage) continue;
    const auto message = Parse<MessageRecord>(record->content);
    if (!message) return Damaged(block, "it contains an invalid message");
    if (!channels.contains(message->channel_id)) {
      return Damaged(block, "it contains a message of an unknown channel");
    }
    if (message->log_time < block.start || message->log_time > block.end) {
      return Damaged(block, "it contains a message outside its time range");
    }
    messages.push_back(*message);
  }
  return messages;
}

base::Result<BlockMessages> ReadMessages(const ByteSource& source, const MessageBlock& block,
                                         const Channels& channels, const Limits& limits) {
  base::Result<Bytes> records = ReadRecords(source, block, limits);
  if (!records) return base::Fail(std::move(records.error()));
  // Moving the vector does not move its elements, so the views of them stay valid.
  BlockMessages result{std::move(*records), {}};
  auto messages = ListMessages(result.records, block, channels);
  if (!messages) return base::Fail(std::move(messages.error()));
  result.messages = std::move(*messages);
  return result;
}

}  // namespace gsv::recording
