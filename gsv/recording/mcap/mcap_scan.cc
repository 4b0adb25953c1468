// Scans a recording without its summary. Reads it record by record, up to the first incomplete one.
#include <algorithm>
#include <set>

#include "gsv/recording/mcap/mcap_summary.h"

namespace gsv::recording {
namespace {

// Messages outside of chunks are grouped in blocks of about this size.
constexpr std::uint64_t kUnchunkedBlockSize = std::uint64_t{4} << 20;
// The number of bytes of an attachment that are read: enough for its name and media type.
constexpr std::uint64_t kAttachmentHeadSize = std::uint64_t{64} << 10;
constexpr std::size_t kMaxProblems = 100;

// A part of the file that is kept in memory, so that small records need no separate reads.
class Window {
 public:
  explicit Window(const ByteSource& source) : source_(source) {}

  // Returns `length` bytes of the file from `offset` on, or no bytes if the file cannot be read
  // there. The result is valid until the next call.
  std::span<const std::byte> Read(std::uint64_t offset, std::uint64_t length) {
    if (offset < start_ || offset + length > start_ + bytes_.size()) {
      const std::uint64_t left = source_.size() - offset;
      base::Result<Bytes> bytes =
          source_.Read(offset, std::min(left, std::max<std::uint64_t>(length, 1 << 20)));
      start_ = offset;
      bytes_ = bytes ? std::move(*bytes) : Bytes{};
      if (bytes_.size() < length) return {};
    }
    return std::span(bytes_).subspan(offset - start_, length);
  }

 private:
  const ByteSource& source_;
  std::uint64_t start_ = 0;
  Bytes bytes_;
};

class Scanner {
 public:
  Scanner(const ByteSource& source, const Limits& limits)
      : source_(source), limits_(limits), window_(source), offset_(kMagic.size()) {}

  Summary Run() {
    while (Step()) {
    }
    return std::move(summary_);
  }

 private:
  // Reads the next record. Returns false at the end.
  bool Step() {
    const std::uint64_t left = source_.size() - offset_;
    if (left == 0) {
      Problem("the file ends without a summary: it was not closed");
      return false;
    }
    ByteReader head(window_.Read(offset_, std::min<std::uint64_t>(left, kRecordHeaderSize)));
    opcode_ = static_cast<Opcode>(head.Get<std::uint8_t>());
    const auto length = head.Get<std::uint64_t>();
    if (!head.ok() || length > left - kRecordHeaderSize) {
      Problem("the file ends in the middle of a record: it was not closed, or is damaged here");
      return false;
    }
    if (opcode_ == Opcode{0}) {
      Problem("the file contains no records from here on");
      return false;
    }
    if (opcode_ == Opcode::kDataEnd || opcode_ == Opcode::kFooter) return false;
    length_ = kRecordHeaderSize + length;
    Take();
    offset_ += length_;
    return true;
  }

  void Take() {
    switch (opcode_) {
      case Opcode::kHeader:
        return TakeHeader();
      case Opcode::kSchema:
        return Define<SchemaRecord>(Content(), summary_.schemas);
      case Opcode::kChannel:
        return Define<ChannelRecord>(Content(), summary_.channels);
      case Opcode::kMessage:
        return TakeUnchunkedMessage();
      case Opcode::kChunk:
        return TakeChunk();
      case Opcode::kAttachment:
        return TakeAttachment();
      case Opcode::kMetadata:
        return TakeMetadata();
      default:
        return;
    }
  }

  // Returns the content of the record. Returns an empty content, which is always invalid, for a
  // record that is too large.
  std::span<const std::byte> Content() {
    const std::uint64_t length = length_ - kRecordHeaderSize;
    if (length > limits_.record_size) return {};
    return window_.Read(offset_ + kRecordHeaderSize, length);
  }

  void TakeHeader() {
    auto header = Parse<HeaderRecord>(Content());
    if (!header) return Problem("the header is damaged");
    summary_.profile = std::move(header->profile);
    summary_.library = std::move(header->library);
  }

  template <typename Record>
  void Define(std::span<const std::byte> content, std::map<std::uint16_t, Record>& map) {
    auto record = Parse<Record>(content);
    if (!record) return Problem("a schema or channel is damaged");
    const auto [known, added] = map.try_emplace(record->id, *record);
    if (!added && known->second != *record) {
      Problem("a schema or channel has two different definitions; the first one is used");
    }
  }

  void TakeUnchunkedMessage() {
    const auto message = Parse<MessageRecord>(Content());
    if (!message || !summary_.channels.contains(message->channel_id)) {
      return Problem("a message is damaged or belongs to no channel");
    }
    std::vector<MessageBlock>& blocks = summary_.blocks;
    const base::SimTime time = message->log_time;
    const bool follows = !blocks.empty() && !blocks.back().is_chunk &&
                         blocks.back().offset + blocks.back().length == offset_ &&
                         blocks.back().length + length_ <= kUnchunkedBlockSize;
    if (!follows) blocks.push_back({offset_, 0, false, 0, time, time});
    MessageBlock& block = blocks.back();
    block.length += length_;
    block.uncompressed_size = block.length;
    block.start = std::min(block.start, time);
    block.end = std::max(block.end, time);
    Count(std::span(&*message, 1));
  }

  void TakeChunk() {
    const auto chunk = Parse<ChunkRecord>(Content());
    if (!chunk) return Problem("a chunk is damaged, or exceeds the size limit");
    const MessageBlock block{offset_,      length_,   true, chunk->uncompressed_size,
                             chunk->start, chunk->end};
    const base::Result<Bytes> records = ReadRecords(source_, block, limits_);
    if (!records) return Problem(records.error());
    for (std::span<const std::byte> rest = *records; const auto record = TakeRecord(rest);) {
      if (record->opcode == Opcode::kSchema) Define(record->content, summary_.schemas);
      if (record->opcode == Opcode::kChannel) Define(record->content, summary_.channels);
    }
    const auto messages = ListMessages(*records, block, summary_.channels);
    if (!messages) return Problem(messages.error());
    Count(*messages);
    summary_.blocks.push_back(block);
    std::set<std::uint16_t> channels;
    for (const MessageRecord& message : *messages) channels.insert(message.channel_id);
    summary_.blocks.back().channels.assign(channels.begin(), channels.end());
  }

  void Count(std::span<const MessageRecord> messages) {
    for (const MessageRecord& message : messages) {
      const bool first = summary_.message_count++ == 0;
      ++summary_.message_counts[message.channel_id];
      const base::SimTime time = message.log_time;
      summary_.start = first ? time : std::min(summary_.start, time);
      summary_.end = first ? time : std::max(summary_.end, time);
    }
  }

  void TakeAttachment() {
    const std::uint64_t length = std::min(length_ - kRecordHeaderSize, kAttachmentHeadSize);
    auto index = ParseAttachmentHead(window_.Read(offset_ + kRecordHeaderSize, length));
    if (!index) return Problem("an attachment is damaged");
    index->offset = offset_;
    index->length = length_;
    summary_.attachments.push_back(std::move(*index));
  }

  void TakeMetadata() {
    auto metadata = Parse<MetadataRecord>(Content());
    if (!metadata) return Problem("a metadata record is damaged");
    summary_.metadata.push_back({offset_, length_, std::move(metadata->name)});
  }

  void Problem(std::string message) {
    Problem(base::Error{base::ErrorCode::kCorrupt, std::move(message),
                        "byte " + std::to_string(offset_)});
  }

  void Problem(const base::Error& error) {
    if (summary_.problems.size() == kMaxProblems) return;
    summary_.problems.push_back({base::Problem::Severity::kWarning, error.message, error.where});
  }

  const ByteSource& source_;
  const Limits& limits_;
  Window window_;
  Summary summary_;
  std::uint64_t offset_;  // offset of the current record
  std::uint64_t length_ = 0;
  Opcode opcode_{};
};

}  // namespace

base::Result<Summary> ScanForSummary(const ByteSource& source, const Limits& limits) {
  const base::Result<Bytes> magic =
      source.Read(0, std::min<std::uint64_t>(source.size(), kMagic.size()));
  if (!magic) return base::Fail(magic.error());
  if (!std::equal(magic->begin(), magic->end(), kMagic.begin(), kMagic.end())) {
    return base::Fail(base::ErrorCode::kCorrupt,
                      "expected a recording in the MCAP format, found other content");
  }
  return Scanner(source, limits).Run();
}

}  // namespace gsv::recording
