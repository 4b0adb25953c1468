#include "gsv/recording/mcap/mcap_file_writer.h"

#include <algorithm>

#include "gsv/base/check.h"

namespace gsv::recording {
namespace {

// Builds the summary section at offset `start`. The section has a group of records for each kind,
// and the offset of each group.
class SummaryBuilder {
 public:
  explicit SummaryBuilder(std::uint64_t start) : start_(start) {}

  template <typename Records>
  void AddGroup(Opcode group, const Records& records) {
    Bytes bytes;
    for (const auto& record : records) Append(bytes, record);
    AddGroup(group, bytes);
  }

  void AddGroup(Opcode group, const Bytes& records) {
    if (records.empty()) return;
    offsets_.push_back({group, start_ + bytes_.size(), records.size()});
    PutBytes(bytes_, records);
  }

  // Returns the section, the footer with its checksum, and the final magic.
  Bytes Finish() {
    const std::uint64_t offset_start = start_ + bytes_.size();
    for (const SummaryOffsetRecord& offset : offsets_) Append(bytes_, offset);
    Append(bytes_, FooterRecord{start_, offset_start, 0});
    const std::size_t crc_at = bytes_.size() - sizeof(std::uint32_t);
    const std::uint32_t crc = Crc32(std::span(bytes_).first(crc_at));
    bytes_.resize(crc_at);
    Put(bytes_, crc);
    PutBytes(bytes_, kMagic);
    return std::move(bytes_);
  }

 private:
  std::uint64_t start_;
  Bytes bytes_;
  std::vector<SummaryOffsetRecord> offsets_;
};

template <typename Record>
std::vector<Record> Values(const std::map<std::uint16_t, Record>& map) {
  std::vector<Record> values;
  values.reserve(map.size());
  for (const auto& [id, record] : map) values.push_back(record);
  return values;
}

}  // namespace

McapFileWriter::McapFileWriter(ByteSink& sink, FileOptions options)
    : sink_(sink), options_(std::move(options)), chunk_(options_.compression_level) {
  Bytes head(kMagic.begin(), kMagic.end());
  Append(head, HeaderRecord{options_.profile, options_.library});
  WriteRaw(head);
}

void McapFileWriter::WriteRaw(std::span<const std::byte> bytes) {
  if (!status_) return;
  status_ = sink_.Write(bytes);
  if (!status_) {
    ends_in_a_record_ = sink_.Truncate(position_).has_value();
    return;
  }
  position_ += bytes.size();
  crc_ = Crc32(bytes, crc_);
}

template <typename Record>
void McapFileWriter::WriteRecord(const Record& record) {
  Bytes bytes;
  Append(bytes, record);
  WriteRaw(bytes);
}

const base::Status& McapFileWriter::AddSchema(SchemaRecord schema) {
  WriteRecord(schema);
  if (status_) schemas_[schema.id] = std::move(schema);
  return status_;
}

const base::Status& McapFileWriter::AddChannel(ChannelRecord channel) {
  WriteRecord(channel);
  if (status_) channels_[channel.id] = std::move(channel);
  return status_;
}

const base::Status& McapFileWriter::Write(const MessageRecord& message) {
  GSV_CHECK(!closed_);
  if (!status_) return status_;
  chunk_.Add(message);
  return chunk_.size() >= options_.chunk_size ? CloseChunk() : status_;
}

const base::Status& McapFileWriter::CloseChunk() {
  return !status_ || chunk_.empty() ? status_ : Write(chunk_.Take(position_));
}

const base::Status& McapFileWriter::WriteChunk(std::span<const std::byte> records) {
  GSV_CHECK(!closed_);
  return CloseChunk() ? Write(chunk_.ChunkOf(records, position_)) : status_;
}

const base::Status& McapFileWriter::Write(const ChunkBuilder::Chunk& chunk) {
  const ChunkIndexRecord& index = chunk.index;
  WriteRaw(chunk.bytes);
  if (!status_) return status_;

  const bool first = statistics_.chunk_count == 0;
  statistics_.start = first ? index.start : std::min(statistics_.start, index.start);
  statistics_.end = first ? index.end : std::max(statistics_.end, index.end);
  ++statistics_.chunk_count;
  for (const auto& [channel, count] : chunk.message_counts) {
    if (message_counts_.size() <= channel) message_counts_.resize(std::size_t{channel} + 1);
    message_counts_[channel] += count;
    statistics_.message_count += count;
  }
  Append(chunk_indexes_, index);
  return status_;
}

const base::Status& McapFileWriter::Attach(const AttachmentRecord& attachment) {
  AttachmentIndexRecord index{.offset = position_,
                              .log_time = attachment.log_time,
                              .create_time = attachment.create_time,
                              .data_size = attachment.data.size(),
                              .name = attachment.name,
                              .media_type = attachment.media_type};
  WriteRecord(attachment);
  index.length = position_ - index.offset;
  if (status_) attachment_indexes_.push_back(std::move(index));
  return status_;
}

const base::Status& McapFileWriter::AddMetadata(const MetadataRecord& metadata) {
  MetadataIndexRecord index{.offset = position_, .name = metadata.name};
  WriteRecord(metadata);
  index.length = position_ - index.offset;
  if (status_) metadata_indexes_.push_back(std::move(index));
  return status_;
}

const base::Status& McapFileWriter::Flush() {
  if (CloseChunk()) status_ = sink_.Sync();
  return status_;
}

const base::Status& McapFileWriter::Close() {
  if (closed_) return status_;
  CloseChunk();
  closed_ = true;
  if (status_) {
    WriteEnd();
    if (status_) status_ = sink_.Sync();
  } else if (ends_in_a_record_ && position_ > 0) {
    // A write has failed, for example because the disk is full, and the incomplete record was cut
    // off the file. This may have freed enough space for the summary, so the writer still tries to
    // write it. status() continues to return the first error.
    base::Status reason = std::exchange(status_, base::Status{});
    WriteEnd();
    status_ = std::move(reason);
  }
  return status_;
}

void McapFileWriter::WriteEnd() {
  WriteRecord(DataEndRecord{crc_});
  statistics_.schema_count = static_cast<std::uint16_t>(schemas_.size());
  statistics_.channel_count = static_cast<std::uint32_t>(channels_.size());
  statistics_.attachment_count = static_cast<std::uint32_t>(attachment_indexes_.size());
  statistics_.metadata_count = static_cast<std::uint32_t>(metadata_indexes_.size());
  for (std::size_t channel = 0; channel < message_counts_.size(); ++channel) {
    if (message_counts_[channel] == 0) continue;
    statistics_.channel_message_counts[static_cast<std::uint16_t>(channel)] =
        message_counts_[channel];
  }

  SummaryBuilder summary(position_);
  summary.AddGroup(Opcode::kSchema, Values(schemas_));
  summary.AddGroup(Opcode::kChannel, Values(channels_));
  summary.AddGroup(Opcode::kStatistics, std::span(&statistics_, 1));
  summary.AddGroup(Opcode::kChunkIndex, chunk_indexes_);
  summary.AddGroup(Opcode::kAttachmentIndex, attachment_indexes_);
  summary.AddGroup(Opcode::kMetadataIndex, metadata_indexes_);
  WriteRaw(summary.Finish());
}

}  // namespace gsv::recording
