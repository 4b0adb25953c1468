#include "gsv/recording/mcap/chunk_ring.h"

#include <algorithm>
#include <utility>

namespace gsv::recording {

class ChunkRing::Sink final : public ByteSink {
 public:
  explicit Sink(std::shared_ptr<ChunkRing> ring) : ring_(std::move(ring)) {}

  base::Status Write(std::span<const std::byte> bytes) override {
    ring_->Write(bytes);
    return {};
  }
  base::Status Sync() override { return {}; }
  base::Status Truncate(std::uint64_t) override { return {}; }

 private:
  const std::shared_ptr<ChunkRing> ring_;
};

// The input of a reader of the ring. A piece is the bytes of one write. Pieces are at their
// original offsets in the recording, with gaps where pieces were dropped.
class ChunkRing::Source final : public ByteSource {
 public:
  explicit Source(std::vector<Piece> pieces) : pieces_(std::move(pieces)) {
    std::sort(pieces_.begin(), pieces_.end(),
              [](const Piece& a, const Piece& b) { return a.offset < b.offset; });
  }

  std::uint64_t size() const override {
    return pieces_.empty() ? 0 : pieces_.back().offset + pieces_.back().bytes->size();
  }

  base::Result<Bytes> Read(std::uint64_t offset, std::uint64_t length) const override {
    const auto after =
        std::upper_bound(pieces_.begin(), pieces_.end(), offset,
                         [](std::uint64_t at, const Piece& piece) { return at < piece.offset; });
    if (after != pieces_.begin()) {
      const Piece& piece = *std::prev(after);
      const std::uint64_t skipped = offset - piece.offset;
      const std::uint64_t size = piece.bytes->size();
      if (skipped <= size && length <= size - skipped) {
        const auto begin = piece.bytes->begin() + static_cast<std::ptrdiff_t>(skipped);
        return Bytes(begin, begin + static_cast<std::ptrdiff_t>(length));
      }
    }
    return base::Fail(base::ErrorCode::kCorrupt, "this part of the history is no longer kept",
                      "byte " + std::to_string(offset));
  }

 private:
  std::vector<Piece> pieces_;
};

std::unique_ptr<ByteSink> ChunkRing::MakeSink() {
  return std::make_unique<Sink>(shared_from_this());
}

// Each write of McapFileWriter contains whole records: a chunk with its message indexes, or one
// other record.
void ChunkRing::Write(std::span<const std::byte> bytes) {
  const base::MutexLock lock(mutex_);
  const Piece piece{offset_, std::make_shared<const Bytes>(bytes.begin(), bytes.end())};
  offset_ += bytes.size();
  std::span<const std::byte> rest = *piece.bytes;
  if (rest.size() >= kMagic.size() && std::equal(kMagic.begin(), kMagic.end(), rest.begin())) {
    return;
  }
  const std::optional<RawRecord> record = TakeRecord(rest);
  if (!record) return;
  if (record->opcode == Opcode::kChunk) {
    if (const auto chunk = Parse<ChunkRecord>(record->content)) AddChunk(*chunk, rest, piece);
  } else {
    AddRecord(*record, piece);
  }
  Shrink();
}

void ChunkRing::AddRecord(const RawRecord& record, const Piece& piece) {
  const std::uint64_t length = piece.bytes->size();
  switch (record.opcode) {
    case Opcode::kSchema:
      if (auto schema = Parse<SchemaRecord>(record.content)) schemas_[schema->id] = *schema;
      return;
    case Opcode::kChannel:
      if (auto channel = Parse<ChannelRecord>(record.content)) channels_[channel->id] = *channel;
      return;
    case Opcode::kAttachment:
      if (const auto attachment = Parse<AttachmentRecord>(record.content)) {
        attachments_.push_back(
            {piece,
             {piece.offset, length, attachment->log_time, attachment->create_time,
              attachment->data.size(), attachment->name, attachment->media_type}});
        size_ += length;
      }
      return;
    case Opcode::kMetadata:
      if (const auto metadata = Parse<MetadataRecord>(record.content)) {
        metadata_.push_back({piece, {piece.offset, length, metadata->name}});
        size_ += length;
      }
      return;
    default:
      return;  // these records end the file; readers of the ring do not need them
  }
}

void ChunkRing::AddChunk(const ChunkRecord& chunk, std::span<const std::byte> indexes,
                         const Piece& piece) {
  Chunk added{piece, {}, {}};
  added.block = {piece.offset, piece.bytes->size() - indexes.size(),
                 true,         chunk.uncompressed_size,
                 chunk.start,  chunk.end};
  while (const std::optional<RawRecord> record = TakeRecord(indexes)) {
    if (record->opcode != Opcode::kMessageIndex) continue;
    // A message index has a channel and the size of its entries. An entry has eight bytes of time
    // and eight bytes of offset.
    ByteReader reader(record->content);
    const auto channel = reader.Get<std::uint16_t>();
    const std::uint64_t messages = reader.Get<std::uint32_t>() / 16;
    if (!reader.ok()) continue;
    added.counts[channel] += messages;
    messages_ += messages;
  }
  for (const auto& [channel, count] : added.counts) added.block.channels.push_back(channel);
  size_ += piece.bytes->size();
  chunks_.push_back(std::move(added));
}

void ChunkRing::Shrink() {
  bool has_dropped = false;
  while (size_ > capacity_ && chunks_.size() > 1) {
    size_ -= chunks_.front().piece.bytes->size();
    chunks_.pop_front();
    has_dropped = true;
  }
  if (has_dropped) DropReplaced();
}

void ChunkRing::DropReplaced() {
  const base::SimTime first = chunks_.front().block.start;
  // The attachments that apply at the start of the first chunk, by name.
  std::map<std::string, const Attached*> in_use;
  for (const Attached& each : attachments_) {
    if (each.index.log_time <= first) in_use[each.index.name] = &each;
  }
  std::vector<Attached> kept;
  for (const Attached& each : attachments_) {
    const auto used = in_use.find(each.index.name);
    if (each.index.log_time > first || used == in_use.end() || used->second == &each) {
      kept.push_back(each);
    } else {
      size_ -= each.piece.bytes->size();
    }
  }
  attachments_ = std::move(kept);
}

ChunkRing::Extent ChunkRing::extent() const {
  const base::MutexLock lock(mutex_);
  Extent extent{{}, {}, size_, messages_};
  if (chunks_.empty()) return extent;
  extent.start = chunks_.front().block.start;
  extent.end = chunks_.front().block.end;
  for (const Chunk& chunk : chunks_) {
    extent.start = std::min(extent.start, chunk.block.start);
    extent.end = std::max(extent.end, chunk.block.end);
  }
  return extent;
}

base::Result<std::unique_ptr<McapReader>> ChunkRing::Open() const {
  const Extent whole = extent();
  Summary summary;
  std::vector<Piece> pieces;
  {
    const base::MutexLock lock(mutex_);
    if (chunks_.empty()) {
      return base::Fail(base::ErrorCode::kNotFound,
                        "no history of this simulation is stored yet; let it run for a moment");
    }
    summary.profile = "ros2";
    summary.library = "gsv";
    summary.schemas = schemas_;
    summary.channels = channels_;
    summary.indexed = true;
    for (const Chunk& chunk : chunks_) {
      pieces.push_back(chunk.piece);
      summary.blocks.push_back(chunk.block);
      for (const auto& [channel, count] : chunk.counts) {
        summary.message_counts[channel] += count;
        summary.message_count += count;
      }
    }
    for (const Attached& each : attachments_) {
      pieces.push_back(each.piece);
      summary.attachments.push_back(each.index);
    }
    for (const auto& [piece, index] : metadata_) {
      pieces.push_back(piece);
      summary.metadata.push_back(index);
    }
  }
  summary.start = whole.start;
  summary.end = whole.end;
  return McapReader::Make(std::make_unique<Source>(std::move(pieces)), std::move(summary));
}

}  // namespace gsv::recording
