#include "gsv/recording/mcap/mcap_records.h"

#include "gsv/recording/mcap/compression.h"

namespace gsv::recording {
namespace {

// Writes the header of a record. The destructor adds to the header the length of the content that
// was appended in between.
class RecordFrame {
 public:
  RecordFrame(Bytes& out, Opcode opcode) : out_(out) {
    Put(out_, static_cast<std::uint8_t>(opcode));
    Put(out_, std::uint64_t{0});
    content_ = out_.size();
  }
  ~RecordFrame() { PatchLength<std::uint64_t>(out_, content_); }
  RecordFrame(const RecordFrame&) = delete;
  RecordFrame& operator=(const RecordFrame&) = delete;

  std::size_t content() const { return content_; }

  // Writes the number of bytes after `start` into the Length field in front of `start`.
  template <typename Length>
  static void PatchLength(Bytes& out, std::size_t start) {
    const auto length = static_cast<Length>(out.size() - start);
    std::memcpy(out.data() + start - sizeof length, &length, sizeof length);
  }

 private:
  Bytes& out_;
  std::size_t content_ = 0;
};

// A buffer of fixed size for the fields of a record, so that `out` grows only once.
template <std::size_t kSize>
class FixedBytes {
 public:
  template <std::unsigned_integral Number>
  void Put(Number value) {
    std::memcpy(bytes_.data() + size_, &value, sizeof value);
    size_ += sizeof value;
  }
  void PutTime(std::chrono::nanoseconds time) {
    GSV_CHECK(time.count() >= 0);
    Put(static_cast<std::uint64_t>(time.count()));
  }

  const std::byte* data() const { return bytes_.data(); }
  static constexpr std::size_t size() { return kSize; }

 private:
  std::array<std::byte, kSize> bytes_;
  std::size_t size_ = 0;
};

// Size of the fields of a message before its data, in bytes.
constexpr std::size_t kMessageHeadSize = 2 + 4 + 8 + 8;

template <typename Map, typename PutEntry>
void PutMap(Bytes& out, const Map& map, PutEntry put_entry) {
  Put(out, std::uint32_t{0});
  const std::size_t start = out.size();
  for (const auto& [key, value] : map) put_entry(key, value);
  RecordFrame::PatchLength<std::uint32_t>(out, start);
}

void PutStrings(Bytes& out, const StringMap& map) {
  PutMap(out, map, [&](const std::string& key, const std::string& value) {
    PutString(out, key);
    PutString(out, value);
  });
}

template <typename Map>
void PutNumbers(Bytes& out, const Map& map) {
  PutMap(out, map, [&](std::uint16_t key, std::uint64_t value) {
    Put(out, key);
    Put(out, value);
  });
}

StringMap GetStrings(ByteReader& reader, bool& ok) {
  ByteReader entries(reader.Take(reader.Get<std::uint32_t>()));
  StringMap map;
  while (entries.ok() && entries.remaining() > 0) {
    std::string key = entries.GetString();
    map[std::move(key)] = entries.GetString();
  }
  ok = ok && entries.ok();
  return map;
}

std::map<std::uint16_t, std::uint64_t> GetNumbers(ByteReader& reader, bool& ok) {
  ByteReader entries(reader.Take(reader.Get<std::uint32_t>()));
  std::map<std::uint16_t, std::uint64_t> map;
  while (entries.ok() && entries.remaining() > 0) {
    const auto key = entries.Get<std::uint16_t>();
    map[key] = entries.Get<std::uint64_t>();
  }
  ok = ok && entries.ok();
  return map;
}

std::vector<std::pair<std::uint16_t, std::uint64_t>> ListOf(
    const std::map<std::uint16_t, std::uint64_t>& map) {
  return {map.begin(), map.end()};
}

template <typename Record>
std::optional<Record> IfOk(bool ok, Record record) {
  if (!ok) return std::nullopt;
  return record;
}

}  // namespace

void Append(Bytes& out, const HeaderRecord& record) {
  const RecordFrame frame(out, Opcode::kHeader);
  PutString(out, record.profile);
  PutString(out, record.library);
}

void Append(Bytes& out, const FooterRecord& record) {
  const RecordFrame frame(out, Opcode::kFooter);
  Put(out, record.summary_start);
  Put(out, record.summary_offset_start);
  Put(out, record.summary_crc);
}

void Append(Bytes& out, const SchemaRecord& record) {
  const RecordFrame frame(out, Opcode::kSchema);
  Put(out, record.id);
  PutString(out, record.name);
  PutString(out, record.encoding);
  PutString(out, record.data);
}

void Append(Bytes& out, const ChannelRecord& record) {
  const RecordFrame frame(out, Opcode::kChannel);
  Put(out, record.id);
  Put(out, record.schema_id);
  PutString(out, record.topic);
  PutString(out, record.message_encoding);
  PutStrings(out, record.metadata);
}

// Optimised, because nearly all records of a file are messages: `out` grows once for all fields, and
// its new bytes are not set to zero first.
void Append(Bytes& out, const MessageRecord& record) {
  FixedBytes<kRecordHeaderSize + kMessageHeadSize> head;
  head.Put(static_cast<std::uint8_t>(Opcode::kMessage));
  head.Put(std::uint64_t{kMessageHeadSize + record.data.size()});
  head.Put(record.channel_id);
  head.Put(record.sequence);
  head.PutTime(record.log_time);
  head.PutTime(record.publish_time);
  out.insert(out.end(), head.data(), head.data() + head.size());
  PutBytes(out, record.data);
}

MessageHead ReadMessageHead(std::span<const std::byte> content) {
  GSV_CHECK(content.size() >= kMessageHeadSize);
  ByteReader reader(content);
  MessageHead head;
  head.channel_id = reader.Get<std::uint16_t>();
  reader.Get<std::uint32_t>();  // the sequence number
  head.log_time = reader.GetTime();
  return head;
}

void Append(Bytes& out, const ChunkRecord& record) {
  const RecordFrame frame(out, Opcode::kChunk);
  PutTime(out, record.start);
  PutTime(out, record.end);
  Put(out, record.uncompressed_size);
  Put(out, record.uncompressed_crc);
  PutString(out, record.compression);
  Put(out, std::uint64_t{record.records.size()});
  PutBytes(out, record.records);
}

void Append(Bytes& out, const MessageIndexRecord& record) {
  const RecordFrame frame(out, Opcode::kMessageIndex);
  Put(out, record.channel_id);
  PutMap(out, record.entries, [&](base::SimTime time, std::uint64_t offset) {
    FixedBytes<2 * sizeof(std::uint64_t)> entry;
    entry.PutTime(time);
    entry.Put(offset);
    PutBytes(out, std::span(entry.data(), entry.size()));
  });
}

void Append(Bytes& out, const ChunkIndexRecord& record) {
  const RecordFrame frame(out, Opcode::kChunkIndex);
  PutTime(out, record.start);
  PutTime(out, record.end);
  Put(out, record.chunk_offset);
  Put(out, record.chunk_length);
  PutNumbers(out, record.message_index_offsets);
  Put(out, record.message_index_length);
  PutString(out, record.compression);
  Put(out, record.compressed_size);
  Put(out, record.uncompressed_size);
}

void Append(Bytes& out, const AttachmentRecord& record) {
  const RecordFrame frame(out, Opcode::kAttachment);
  PutTime(out, record.log_time);
  PutTime(out, record.create_time);
  PutString(out, record.name);
  PutString(out, record.media_type);
  Put(out, std::uint64_t{record.data.size()});
  PutBytes(out, record.data);
  Put(out, Crc32(std::span(out).subspan(frame.content())));
}

void Append(Bytes& out, const AttachmentIndexRecord& record) {
  const RecordFrame frame(out, Opcode::kAttachmentIndex);
  Put(out, record.offset);
  Put(out, record.length);
  PutTime(out, record.log_time);
  PutTime(out, record.create_time);
  Put(out, record.data_size);
  PutString(out, record.name);
  PutString(out, record.media_type);
}

void Append(Bytes& out, const StatisticsRecord& record) {
  const RecordFrame frame(out, Opcode::kStatistics);
  Put(out, record.message_count);
  Put(out, record.schema_count);
  Put(out, record.channel_count);
  Put(out, record.attachment_count);
  Put(out, record.metadata_count);
  Put(out, record.chunk_count);
  PutTime(out, record.start);
  PutTime(out, record.end);
  PutNumbers(out, record.channel_message_counts);
}

void Append(Bytes& out, const MetadataRecord& record) {
  const RecordFrame frame(out, Opcode::kMetadata);
  PutString(out, record.name);
  PutStrings(out, record.values);
}

void Append(Bytes& out, const MetadataIndexRecord& record) {
  const RecordFrame frame(out, Opcode::kMetadataIndex);
  Put(out, record.offset);
  Put(out, record.length);
  PutString(out, record.name);
}

void Append(Bytes& out, const SummaryOffsetRecord& record) {
  const RecordFrame frame(out, Opcode::kSummaryOffset);
  Put(out, static_cast<std::uint8_t>(record.group));
  Put(out, record.start);
  Put(out, record.length);
}

void Append(Bytes& out, const DataEndRecord& record) {
  const RecordFrame frame(out, Opcode::kDataEnd);
  Put(out, record.data_crc);
}

// The following functions read the fields of a record in a braced list, because C++ evaluates its
// initialisers in the order in which they are written.

template <>
std::optional<HeaderRecord> Parse(std::span<const std::byte> content) {
  ByteReader reader(content);
  HeaderRecord record{reader.GetString(), reader.GetString()};
  return IfOk(reader.ok(), std::move(record));
}

template <>
std::optional<FooterRecord> Parse(std::span<const std::byte> content) {
  ByteReader reader(content);
  FooterRecord record{reader.Get<std::uint64_t>(), reader.Get<std::uint64_t>(),
                      reader.Get<std::uint32_t>()};
  return IfOk(reader.ok(), record);
}

template <>
std::optional<SchemaRecord> Parse(std::span<const std::byte> content) {
  ByteReader reader(content);
  SchemaRecord record{reader.Get<std::uint16_t>(), reader.GetString(), reader.GetString(),
                      reader.GetString()};
  return IfOk(reader.ok() && record.id != 0, std::move(record));
}

template <>
std::optional<ChannelRecord> Parse(std::span<const std::byte> content) {
  ByteReader reader(content);
  bool ok = true;
  ChannelRecord record{reader.Get<std::uint16_t>(), reader.Get<std::uint16_t>(), reader.GetString(),
                       reader.GetString(), GetStrings(reader, ok)};
  return IfOk(ok && reader.ok(), std::move(record));
}

template <>
std::optional<MessageRecord> Parse(std::span<const std::byte> content) {
  ByteReader reader(content);
  MessageRecord record{reader.Get<std::uint16_t>(), reader.Get<std::uint32_t>(), reader.GetTime(),
                       reader.GetTime(), reader.Take(reader.remaining())};
  return IfOk(reader.ok(), record);
}

template <>
std::optional<ChunkRecord> Parse(std::span<const std::byte> content) {
  ByteReader reader(content);
  ChunkRecord record{reader.GetTime(),
                     reader.GetTime(),
                     reader.Get<std::uint64_t>(),
                     reader.Get<std::uint32_t>(),
                     reader.GetString(),
                     reader.Take(reader.Get<std::uint64_t>())};
  return IfOk(reader.ok(), std::move(record));
}

template <>
std::optional<ChunkIndexRecord> Parse(std::span<const std::byte> content) {
  ByteReader reader(content);
  bool ok = true;
  ChunkIndexRecord record{reader.GetTime(),
                          reader.GetTime(),
                          reader.Get<std::uint64_t>(),
                          reader.Get<std::uint64_t>(),
                          ListOf(GetNumbers(reader, ok)),
                          reader.Get<std::uint64_t>(),
                          reader.GetString(),
                          reader.Get<std::uint64_t>(),
                          reader.Get<std::uint64_t>()};
  return IfOk(ok && reader.ok(), std::move(record));
}

template <>
std::optional<AttachmentRecord> Parse(std::span<const std::byte> content) {
  ByteReader reader(content);
  AttachmentRecord record{reader.GetTime(), reader.GetTime(), reader.GetString(),
                          reader.GetString(), reader.Take(reader.Get<std::uint64_t>())};
  const std::size_t covered = content.size() - reader.remaining();
  const auto crc = reader.Get<std::uint32_t>();
  const bool intact = crc == 0 || (reader.ok() && crc == Crc32(content.first(covered)));
  return IfOk(reader.ok() && intact, std::move(record));
}

std::optional<AttachmentIndexRecord> ParseAttachmentHead(std::span<const std::byte> content) {
  ByteReader reader(content);
  AttachmentIndexRecord record{};
  record.log_time = reader.GetTime();
  record.create_time = reader.GetTime();
  record.name = reader.GetString();
  record.media_type = reader.GetString();
  record.data_size = reader.Get<std::uint64_t>();
  return IfOk(reader.ok(), std::move(record));
}

template <>
std::optional<AttachmentIndexRecord> Parse(std::span<const std::byte> content) {
  ByteReader reader(content);
  AttachmentIndexRecord record{
      reader.Get<std::uint64_t>(), reader.Get<std::uint64_t>(), reader.GetTime(),  reader.GetTime(),
      reader.Get<std::uint64_t>(), reader.GetString(),          reader.GetString()};
  return IfOk(reader.ok(), std::move(record));
}

template <>
std::optional<StatisticsRecord> Parse(std::span<const std::byte> content) {
  ByteReader reader(content);
  bool ok = true;
  StatisticsRecord record{reader.Get<std::uint64_t>(),
                          reader.Get<std::uint16_t>(),
                          reader.Get<std::uint32_t>(),
                          reader.Get<std::uint32_t>(),
                          reader.Get<std::uint32_t>(),
                          reader.Get<std::uint32_t>(),
                          reader.GetTime(),
                          reader.GetTime(),
                          GetNumbers(reader, ok)};
  return IfOk(ok && reader.ok(), std::move(record));
}

template <>
std::optional<MetadataRecord> Parse(std::span<const std::byte> content) {
  ByteReader reader(content);
  bool ok = true;
  MetadataRecord record{reader.GetString(), GetStrings(reader, ok)};
  return IfOk(ok && reader.ok(), std::move(record));
}

template <>
std::optional<MetadataIndexRecord> Parse(std::span<const std::byte> content) {
  ByteReader reader(content);
  MetadataIndexRecord record{reader.Get<std::uint64_t>(), reader.Get<std::uint64_t>(),
                             reader.GetString()};
  return IfOk(reader.ok(), std::move(record));
}

std::optional<RawRecord> TakeRecord(std::span<const std::byte>& records) {
  ByteReader reader(records);
  const RawRecord record{static_cast<Opcode>(reader.Get<std::uint8_t>()),
                         reader.Take(reader.Get<std::uint64_t>())};
  if (!reader.ok()) return std::nullopt;
  records = records.last(reader.remaining());
  return record;
}

}  // namespace gsv::recording
