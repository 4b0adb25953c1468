// Iterates over the messages of a recording by time. Messages with equal times are in the order of
// the file.
#pragma once

#include <optional>
#include <queue>

#include "gsv/recording/mcap/mcap_summary.h"

namespace gsv::recording {

class MessageCursor {
 public:
  // Starts at the first message not before `from`. The arguments must outlive the cursor.
  MessageCursor(const ByteSource& source, const Summary& summary, const Limits& limits,
                base::SimTime from);

  // Returns the next message, which is valid until the next call, or nullopt at the end. For a
  // damaged chunk, returns an error once; the next call continues after the chunk.
  [[nodiscard]] base::Result<std::optional<MessageRecord>> Next();

 private:
  // A block that was read, of which some messages are still to be returned.
  struct OpenBlock {
    std::uint64_t offset = 0;  // offset in the file
    BlockMessages content;     // messages, ordered by time
    std::size_t next = 0;      // index of the next message to return

    const MessageRecord& front() const { return content.messages[next]; }
  };
  // Orders next_: the block whose next message is the earliest is at the top.
  struct Later {
    bool operator()(const OpenBlock* a, const OpenBlock* b) const;
  };

  // Opens blocks until no closed block can contain an earlier message than the open blocks.
  base::Status OpenBlocksThatMayBeNext();
  // Reads a block, and adds it to the open blocks.
  base::Status Open(const MessageBlock& block);
  // Frees the block whose last message was returned.
  void DropExhausted();

  const ByteSource& source_;
  const Summary& summary_;
  const Limits& limits_;
  const base::SimTime from_;  // earlier messages are left out
  // Blocks that are not open yet; the earliest is at the end.
  std::vector<const MessageBlock*> waiting_;
  std::vector<std::unique_ptr<OpenBlock>> open_;  // owns all blocks that are open
  // The open blocks that still have messages.
  std::priority_queue<OpenBlock*, std::vector<OpenBlock*>, Later> next_;
  OpenBlock* exhausted_ = nullptr;  // the block of the message that was returned last
  std::uint64_t open_size_ = 0;     // number of bytes of all open blocks, uncompressed
};

}  // namespace gsv::recording
