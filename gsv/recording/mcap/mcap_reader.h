// Reads a recording: what it holds, its messages from any time on, its attachments and metadata.
//
// Input    hostile, see mcap_block.h. A file that was cut off or damaged is read as far as it makes
//          sense; summary().problems tells what is missing.
// Threads  const members may run concurrently.
#pragma once

#include <memory>
#include <string>

#include "gsv/recording/mcap/mcap_summary.h"
#include "gsv/recording/mcap/message_cursor.h"

namespace gsv::recording {

// A file that belongs to a recording.
struct Attachment {
  std::string name;
  std::string media_type;
  std::chrono::nanoseconds log_time{};     // simulated
  std::chrono::nanoseconds create_time{};  // of the file, since 1970
  Bytes data;
};

class McapReader {
 public:
  // A file, or a folder that holds one (see bag_folder.h). kNotFound, or kCorrupt if it is no
  // recording at all.
  [[nodiscard]] static base::Result<std::unique_ptr<McapReader>> Open(const std::string& path,
                                                                      const Limits& limits = {});
  [[nodiscard]] static base::Result<std::unique_ptr<McapReader>> Open(
      std::unique_ptr<ByteSource> source, const Limits& limits = {});

  const Summary& summary() const { return summary_; }
  const Limits& limits() const { return limits_; }
  std::uint64_t size() const { return source_->size(); }

  // The messages from `from` on, by time. The reader must outlive the cursor.
  MessageCursor Messages(base::SimTime from = base::SimTime::min()) const;
  // The messages of one of summary().blocks, as they follow each other in the file.
  [[nodiscard]] base::Result<BlockMessages> Messages(const MessageBlock& block) const;

  // Those of summary().attachments and summary().metadata. kCorrupt if a checksum is wrong.
  [[nodiscard]] base::Result<Attachment> Read(const AttachmentIndexRecord& index) const;
  [[nodiscard]] base::Result<MetadataRecord> Read(const MetadataIndexRecord& index) const;

 private:
  McapReader(std::unique_ptr<ByteSource> source, const Limits& limits, Summary summary)
      : source_(std::move(source)), limits_(limits), summary_(std::move(summary)) {}

  template <typename Record, typename Use>
  auto ReadRecord(Opcode opcode, std::uint64_t offset, std::uint64_t length, Use use) const
      -> base::Result<decltype(use(std::declval<Record&>()))>;

  const std::unique_ptr<ByteSource> source_;
  const Limits limits_;
  const Summary summary_;
};

}  // namespace gsv::recording
