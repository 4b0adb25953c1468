// Writes an MCAP file, record by record, in the thread that calls.
//
// Format   docs/formats/recording.md: messages in zstd chunks, each with its message index; schemas
//          and channels outside of chunks, so that a damaged chunk takes no other with it; at the
//          end a summary. All checksums are given.
// Errors   the first one ends the recording: it is kept in status(), and all later calls return
//          it. What was complete stays readable: the file is cut off behind the last whole record,
//          and Close() still tries to write the summary.
// Threads  one at a time. McapWriter is the one for several, and never waits for the disk.
#pragma once

#include "gsv/base/error.h"
#include "gsv/recording/mcap/chunk_builder.h"
#include "gsv/recording/mcap/file_io.h"
#include "gsv/recording/mcap/mcap_records.h"

namespace gsv::recording {

struct FileOptions {
  std::string profile = "ros2";
  std::string library = "gsv";
  // A chunk is closed when its messages are this many bytes, uncompressed.
  std::size_t chunk_size = std::size_t{1} << 20;
  int compression_level = 3;
};

class McapFileWriter {
 public:
  // Writes the head of the file. `sink` must outlive the writer.
  McapFileWriter(ByteSink& sink, FileOptions options);

  base::Status AddSchema(SchemaRecord schema);
  // Its schema must have been added.
  base::Status AddChannel(ChannelRecord channel);
  // Its channel must have been added.
  base::Status Write(const MessageRecord& message);
  base::Status Attach(const AttachmentRecord& attachment);
  base::Status AddMetadata(const MetadataRecord& metadata);

  // Writes the current chunk, if there is anything in it: from then on a crash of this process
  // leaves it readable.
  base::Status CloseChunk();
  // The same, and returns when it would survive a loss of power.
  base::Status Flush();
  // Writes the rest and the summary. Nothing may follow.
  base::Status Close();

  const base::Status& status() const { return status_; }
  std::uint64_t bytes_written() const { return position_; }

 private:
  void WriteRaw(std::span<const std::byte> bytes);
  template <typename Record>
  void WriteRecord(const Record& record);
  void WriteEnd();

  ByteSink& sink_;
  const FileOptions options_;
  base::Status status_;
  bool closed_ = false;
  bool ends_in_a_record_ = true;  // after an error: whether the file could be cut there
  std::uint64_t position_ = 0;
  std::uint32_t crc_ = 0;  // of all before position_
  ChunkBuilder chunk_;

  // For the summary.
  std::map<std::uint16_t, SchemaRecord> schemas_;
  std::map<std::uint16_t, ChannelRecord> channels_;
  Bytes chunk_indexes_;  // as records: a long recording has many, with many channels each
  std::vector<AttachmentIndexRecord> attachment_indexes_;
  std::vector<MetadataIndexRecord> metadata_indexes_;
  StatisticsRecord statistics_;
};

}  // namespace gsv::recording
