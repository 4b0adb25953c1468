// The records of an MCAP file as plain structs, with their encoding.
//
// Format  MCAP, version 0 of its specification (mcap.dev/spec): a record is an opcode, the length
//         of its content (64 bits) and the content. docs/formats/recording.md describes their order
//         in a file.
// Errors  Parse() accepts any bytes, and returns nullopt for an invalid record.
#pragma once

#include <array>
#include <optional>
#include <utility>

#include "gsv/base/sim_time.h"
#include "gsv/recording/mcap/byte_order.h"

namespace gsv::recording {

// The first and the last eight bytes of every MCAP file.
inline constexpr std::array<std::byte, 8> kMagic{std::byte{0x89}, std::byte{'M'}, std::byte{'C'},
                                                 std::byte{'A'},  std::byte{'P'}, std::byte{'0'},
                                                 std::byte{'\r'}, std::byte{'\n'}};

enum class Opcode : std::uint8_t {
  kHeader = 0x01,
  kFooter = 0x02,
  kSchema = 0x03,
  kChannel = 0x04,
  kMessage = 0x05,
  kChunk = 0x06,
  kMessageIndex = 0x07,
  kChunkIndex = 0x08,
  kAttachment = 0x09,
  kAttachmentIndex = 0x0a,
  kStatistics = 0x0b,
  kMetadata = 0x0c,
  kMetadataIndex = 0x0d,
  kSummaryOffset = 0x0e,
  kDataEnd = 0x0f,
};

// bytes of opcode and length before a record's content
inline constexpr std::size_t kRecordHeaderSize = 9;

struct HeaderRecord {
  std::string profile;  // name of the conventions that the file follows, such as "ros2"
  std::string library;  // name of the program that wrote the file
};

struct FooterRecord {
  std::uint64_t summary_start = 0;  // 0 if there is no summary
  // offset of the SummaryOffset records; 0 if there are none
  std::uint64_t summary_offset_start = 0;
  std::uint32_t summary_crc = 0;  // 0 if there is no checksum
};
// Size of a complete footer record, in bytes.
inline constexpr std::size_t kFooterSize = kRecordHeaderSize + 20;

struct SchemaRecord {
  std::uint16_t id = 0;  // must not be 0
  std::string name;
  std::string encoding;  // language of `data`, such as "ros2msg"
  std::string data;      // definition of the message type

  friend bool operator==(const SchemaRecord&, const SchemaRecord&) = default;
};

struct ChannelRecord {
  std::uint16_t id = 0;
  std::uint16_t schema_id = 0;  // 0 if the channel has no schema
  std::string topic;
  std::string message_encoding;  // encoding of the channel's messages, such as "cdr"
  StringMap metadata;

  friend bool operator==(const ChannelRecord&, const ChannelRecord&) = default;
};

struct MessageRecord {
  std::uint16_t channel_id = 0;
  std::uint32_t sequence = 0;  // number of the message within its channel
  base::SimTime log_time{};
  base::SimTime publish_time{};
  std::span<const std::byte> data;  // the struct does not own these bytes
};

struct ChunkRecord {
  base::SimTime start{};  // time of the earliest message
  base::SimTime end{};    // time of the latest message
  std::uint64_t uncompressed_size = 0;
  std::uint32_t uncompressed_crc = 0;  // 0 if there is no checksum
  std::string compression;             // empty, or a name such as "zstd"
  std::span<const std::byte> records;  // the struct does not own these bytes
};

// Where the messages of one channel are in a chunk: pairs of time and offset in the uncompressed
// records.
struct MessageIndexRecord {
  std::uint16_t channel_id = 0;
  std::vector<std::pair<base::SimTime, std::uint64_t>> entries;
};

struct ChunkIndexRecord {
  base::SimTime start{};
  base::SimTime end{};
  std::uint64_t chunk_offset = 0;  // offset of the chunk's record in the file
  std::uint64_t chunk_length = 0;  // length of the whole record
  // Pairs of a channel and the offset of its message index in the file, ordered by channel.
  std::vector<std::pair<std::uint16_t, std::uint64_t>> message_index_offsets{};
  std::uint64_t message_index_length = 0;  // length of all message index records of the chunk
  std::string compression{};
  std::uint64_t compressed_size = 0;
  std::uint64_t uncompressed_size = 0;
};

struct AttachmentRecord {
  std::chrono::nanoseconds log_time{};     // simulated time
  std::chrono::nanoseconds create_time{};  // when the file was created, since 1970
  std::string name;
  std::string media_type;
  std::span<const std::byte> data;  // the struct does not own these bytes
};

struct AttachmentIndexRecord {
  std::uint64_t offset = 0;  // offset of the attachment's record in the file
  std::uint64_t length = 0;  // length of the whole record
  std::chrono::nanoseconds log_time{};
  std::chrono::nanoseconds create_time{};
  std::uint64_t data_size = 0;  // number of bytes of the attached file
  std::string name;
  std::string media_type;
};

struct StatisticsRecord {
  std::uint64_t message_count = 0;
  std::uint16_t schema_count = 0;
  std::uint32_t channel_count = 0;
  std::uint32_t attachment_count = 0;
  std::uint32_t metadata_count = 0;
  std::uint32_t chunk_count = 0;
  base::SimTime start{};
  base::SimTime end{};
  std::map<std::uint16_t, std::uint64_t> channel_message_counts{};
};

struct MetadataRecord {
  std::string name;
  StringMap values;  // values by name

  friend bool operator==(const MetadataRecord&, const MetadataRecord&) = default;
};

struct MetadataIndexRecord {
  std::uint64_t offset = 0;  // offset of the metadata record in the file
  std::uint64_t length = 0;  // length of the whole record
  std::string name;
};

// The place in the summary where the records of one kind are.
struct SummaryOffsetRecord {
  Opcode group{};           // the kind of these records
  std::uint64_t start = 0;  // offset of the first of these records in the file
  std::uint64_t length = 0;
};

struct DataEndRecord {
  std::uint32_t data_crc = 0;  // checksum of all bytes before this record; 0 if there is none
};

// These functions append the complete record. The record of an attachment includes its CRC.
void Append(Bytes& out, const HeaderRecord& record);
void Append(Bytes& out, const FooterRecord& record);
void Append(Bytes& out, const SchemaRecord& record);
void Append(Bytes& out, const ChannelRecord& record);
void Append(Bytes& out, const MessageRecord& record);
void Append(Bytes& out, const ChunkRecord& record);
void Append(Bytes& out, const MessageIndexRecord& record);
void Append(Bytes& out, const ChunkIndexRecord& record);
void Append(Bytes& out, const AttachmentRecord& record);
void Append(Bytes& out, const AttachmentIndexRecord& record);
void Append(Bytes& out, const StatisticsRecord& record);
void Append(Bytes& out, const MetadataRecord& record);
void Append(Bytes& out, const MetadataIndexRecord& record);
void Append(Bytes& out, const SummaryOffsetRecord& record);
void Append(Bytes& out, const DataEndRecord& record);

// The start of a message's content, which Append() encodes first.
struct MessageHead {
  std::uint16_t channel_id = 0;
  base::SimTime log_time{};
};
// Reads the start of the content of a message that Append() has encoded.
MessageHead ReadMessageHead(std::span<const std::byte> content);

// Parses the content of one record, without opcode and length. Not defined for MessageIndex,
// SummaryOffset and DataEnd, which readers do not need. Checks the CRC of an attachment.
template <typename Record>
std::optional<Record> Parse(std::span<const std::byte> content);
template <>
std::optional<HeaderRecord> Parse(std::span<const std::byte> content);
template <>
std::optional<FooterRecord> Parse(std::span<const std::byte> content);
template <>
std::optional<SchemaRecord> Parse(std::span<const std::byte> content);
template <>
std::optional<ChannelRecord> Parse(std::span<const std::byte> content);
template <>
std::optional<MessageRecord> Parse(std::span<const std::byte> content);
template <>
std::optional<ChunkRecord> Parse(std::span<const std::byte> content);
template <>
std::optional<ChunkIndexRecord> Parse(std::span<const std::byte> content);
template <>
std::optional<AttachmentRecord> Parse(std::span<const std::byte> content);
template <>
std::optional<AttachmentIndexRecord> Parse(std::span<const std::byte> content);
template <>
std::optional<StatisticsRecord> Parse(std::span<const std::byte> content);
template <>
std::optional<MetadataRecord> Parse(std::span<const std::byte> content);
template <>
std::optional<MetadataIndexRecord> Parse(std::span<const std::byte> content);

// Parses the start of an attachment. `content` may end after the media type.
std::optional<AttachmentIndexRecord> ParseAttachmentHead(std::span<const std::byte> content);

// A record whose content was not parsed.
struct RawRecord {
  Opcode opcode{};
  std::span<const std::byte> content;  // the bytes after opcode and length
};

// Removes the next record from `records` and returns it, or nullopt if it is incomplete.
std::optional<RawRecord> TakeRecord(std::span<const std::byte>& records);

}  // namespace gsv::recording
