// Writes an MCAP file, record by record, on the calling thread.
//
// Format   docs/formats/recording.md. Messages are in zstd chunks, each with its message index.
//          Schemas and channels are outside of chunks, so that a damaged chunk affects no other.
//          The summary is at the end. All checksums are written.
// Errors   the first error ends the recording, and status() and all later calls return it. Complete
//          records stay readable: the file is truncated after the last complete record, and Close()
//          still tries to write the summary.
// Threads  one at a time. For several threads, use McapWriter, which writes on its own thread.
#pragma once

#include "gsv/base/error.h"
#include "gsv/recording/mcap/chunk_builder.h"
#include "gsv/recording/mcap/file_io.h"
#include "gsv/recording/mcap/mcap_records.h"

namespace gsv::recording {

// The properties of an MCAP file.
struct FileOptions {
  std::string profile = "ros2";  // MCAP's name for the conventions that the file follows
  std::string library = "gsv";   // name of the program that writes the file
  // A chunk is closed when its messages have this many bytes, uncompressed.
  std::size_t chunk_size = std::size_t{1} << 20;
  // zstd's level. Level 1 takes a third more time, for files that are 3 % smaller.
  int compression_level = -1;
};

class McapFileWriter {
 public:
  // Writes the start of the file. `sink` must outlive the writer.
  McapFileWriter(ByteSink& sink, FileOptions options);

  const base::Status& AddSchema(SchemaRecord schema);
  // Adds a channel. Its schema must have been added before.
  const base::Status& AddChannel(ChannelRecord channel);
  // Writes a message. Its channel must have been added before.
  const base::Status& Write(const MessageRecord& message);
  // Writes the current chunk, and then a chunk of `records`, which contains complete records of
  // messages. This saves the copy that Write() makes.
  const base::Status& WriteChunk(std::span<const std::byte> records);
  // Writes an attachment.
  const base::Status& Attach(const AttachmentRecord& attachment);
  const base::Status& AddMetadata(const MetadataRecord& metadata);

  // Writes the current chunk, unless it is empty. The chunk then survives a crash of this process.
  const base::Status& CloseChunk();
  // Writes the current chunk, and returns when it survives a loss of power.
  const base::Status& Flush();
  // Writes the current chunk and the summary. No other call may follow.
  const base::Status& Close();

  const base::Status& status() const { return status_; }
  std::uint64_t bytes_written() const { return position_; }

 private:
  // Writes a chunk, and adds it to the summary.
  const base::Status& Write(const ChunkBuilder::Chunk& chunk);
  // Writes bytes to the sink, and updates position_ and crc_.
  void WriteRaw(std::span<const std::byte> bytes);
  template <typename Record>
  void WriteRecord(const Record& record);
  // Writes everything behind the last chunk: the end of the data, the summary and the footer.
  void WriteEnd();

  ByteSink& sink_;
  const FileOptions options_;
  base::Status status_;
  bool closed_ = false;  // whether Close() was called
  // Whether the last record is complete; false if truncating failed after an error.
  bool ends_in_a_record_ = true;
  std::uint64_t position_ = 0;  // number of bytes written so far
  std::uint32_t crc_ = 0;       // checksum of all bytes before position_
  ChunkBuilder chunk_;

  // The following members are collected for the summary.
  std::map<std::uint16_t, SchemaRecord> schemas_;
  std::map<std::uint16_t, ChannelRecord> channels_;
  Bytes chunk_indexes_;  // encoded, to save memory in long recordings with many chunks
  std::vector<AttachmentIndexRecord> attachment_indexes_;
  std::vector<MetadataIndexRecord> metadata_indexes_;
  StatisticsRecord statistics_;                // its channel_message_counts are empty
  std::vector<std::uint64_t> message_counts_;  // number of messages, by channel
};

}  // namespace gsv::recording
