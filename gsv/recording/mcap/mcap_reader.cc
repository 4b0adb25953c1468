#include "gsv/recording/mcap/mcap_reader.h"

#include "gsv/recording/mcap/bag_folder.h"

namespace gsv::recording {

base::Result<std::unique_ptr<McapReader>> McapReader::Open(const std::string& name,
                                                           const Limits& limits) {
  const std::string path = RecordingFile(name);
  auto source = FileSource::Open(path);
  if (!source) return base::Fail(std::move(source.error()));
  auto reader = Open(std::move(*source), limits);
  if (!reader) reader.error().where = path;
  return reader;
}

base::Result<std::unique_ptr<McapReader>> McapReader::Open(std::unique_ptr<ByteSource> source,
                                                           const Limits& limits) {
  base::Result<Summary> summary = LoadSummary(*source, limits);
  if (!summary) return base::Fail(std::move(summary.error()));
  return std::unique_ptr<McapReader>(
      new McapReader(std::move(source), limits, std::move(*summary)));
}

std::unique_ptr<McapReader> McapReader::Make(std::unique_ptr<ByteSource> source, Summary summary,
                                             const Limits& limits) {
  return std::unique_ptr<McapReader>(new McapReader(std::move(source), limits, std::move(summary)));
}

MessageCursor McapReader::Messages(base::SimTime from) const {
  return MessageCursor(*source_, summary_, limits_, from);
}

base::Result<BlockMessages> McapReader::Messages(const MessageBlock& block) const {
  return ReadMessages(*source_, block, summary_.channels, limits_);
}

template <typename Record, typename Use>
auto McapReader::ReadRecord(Opcode opcode, std::uint64_t offset, std::uint64_t length,
                            Use use) const -> base::Result<decltype(use(std::declval<Record&>()))> {
  const base::Result<Bytes> bytes = source_->Read(offset, length);
  if (!bytes) return base::Fail(bytes.error());
  std::span<const std::byte> rest = *bytes;
  const std::optional<RawRecord> raw = TakeRecord(rest);
  std::optional<Record> record;
  if (raw && raw->opcode == opcode) record = Parse<Record>(raw->content);
  if (!record) {
    return base::Fail(base::ErrorCode::kCorrupt,
                      "the data here is damaged, or does not match the summary",
                      "byte " + std::to_string(offset));
  }
  return use(*record);
}

base::Result<Attachment> McapReader::Read(const AttachmentIndexRecord& index) const {
  return ReadRecord<AttachmentRecord>(
      Opcode::kAttachment, index.offset, index.length, [](AttachmentRecord& record) {
        return Attachment{std::move(record.name), std::move(record.media_type), record.log_time,
                          record.create_time, Bytes(record.data.begin(), record.data.end())};
      });
}

base::Result<MetadataRecord> McapReader::Read(const MetadataIndexRecord& index) const {
  return ReadRecord<MetadataRecord>(Opcode::kMetadata, index.offset, index.length,
                                    [](MetadataRecord& record) { return std::move(record); });
}

}  // namespace gsv::recording
