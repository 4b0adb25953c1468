// Reads a recording: its summary, its messages from a given time on, its attachments and metadata.
//
// Input    untrusted, see mcap_block.h. A truncated or damaged file is read as far as possible;
//          summary().problems lists what is missing.
// Threads  const members may run concurrently.
#pragma once

#include <memory>
#include <string>

#include "gsv/recording/mcap/mcap_summary.h"
#include "gsv/recording/mcap/message_cursor.h"

namespace gsv::recording {

// A file inside a recording.
struct Attachment {
  std::string name;
  std::string media_type;
  std::chrono::nanoseconds log_time{};     // simulated time at which the file was attached
  std::chrono::nanoseconds create_time{};  // when the file was created, since 1970
  Bytes data;
};

class McapReader {
 public:
  // Opens a file, or the recording in a folder (see bag_folder.h). Returns kNotFound, or kCorrupt
  // if it is not a recording.
  [[nodiscard]] static base::Result<std::unique_ptr<McapReader>> Open(const std::string& path,
                                                                      const Limits& limits = {});
  [[nodiscard]] static base::Result<std::unique_ptr<McapReader>> Open(
      std::unique_ptr<ByteSource> source, const Limits& limits = {});
  // Makes a reader for a source whose summary is known and valid.
  static std::unique_ptr<McapReader> Make(std::unique_ptr<ByteSource> source, Summary summary,
                                          const Limits& limits = {});

  const Summary& summary() const { return summary_; }
  const Limits& limits() const { return limits_; }
  std::uint64_t size() const { return source_->size(); }

  // Iterates over the messages from `from` on, ordered by time. The reader must outlive the cursor.
  MessageCursor Messages(base::SimTime from = base::SimTime::min()) const;
  // Returns the messages of a block (one of summary().blocks), in the order of the file.
  [[nodiscard]] base::Result<BlockMessages> Messages(const MessageBlock& block) const;

  // Read one attachment or metadata record that is listed in summary(). Fail with kCorrupt if a
  // checksum is wrong.
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
