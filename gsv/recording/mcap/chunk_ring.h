// Keeps the newest part of a recording in memory. It is an output for McapWriter. If all records
// together exceed the capacity, the oldest chunks are dropped.
//
// Kept     All schemas, channels and metadata are kept, and the newest chunks. If several
//          attachments have the same name, an attachment is dropped when a later one has replaced
//          it before the start of the first kept chunk.
// Threads  any.
#pragma once

#include <deque>
#include <map>
#include <memory>
#include <vector>

#include "gsv/base/mutex.h"
#include "gsv/recording/mcap/mcap_reader.h"

namespace gsv::recording {

// A ring buffer of the newest chunks of a recording.
class ChunkRing : public std::enable_shared_from_this<ChunkRing> {
 public:
  // `capacity` is the maximum size of all records as they are stored (compressed), in bytes. The
  // newest chunk is kept, whatever its size.
  explicit ChunkRing(std::size_t capacity) : capacity_(capacity) {}

  // Makes an output for one McapWriter. The output keeps the ring alive.
  std::unique_ptr<ByteSink> MakeSink();

  // The time range and the number of messages.
  struct Extent {
    base::SimTime start{}, end{};  // range of the times of the kept messages
    std::size_t bytes = 0;         // size of the kept records
    std::uint64_t messages = 0;    // number of written messages, including dropped ones
  };
  Extent extent() const;

  // Returns a reader of the messages that are kept now; later writes do not change it. Fails with
  // kNotFound if there are no messages yet.
  [[nodiscard]] base::Result<std::unique_ptr<McapReader>> Open() const;

 private:
  // Sink is the output of MakeSink(). Source is the input of a reader that Open() makes.
  class Sink;
  class Source;
  // Bytes that the ring and its readers share.
  using Stored = std::shared_ptr<const Bytes>;
  // The bytes of one write, which are whole records.
  struct Piece {
    std::uint64_t offset = 0;  // offset in the written file
    Stored bytes;
  };
  // A chunk that the ring keeps, with its message index.
  struct Chunk {
    Piece piece;
    MessageBlock block;
    std::map<std::uint16_t, std::uint64_t> counts;  // number of messages by channel
  };
  // An attachment that the ring keeps.
  struct Attached {
    Piece piece;
    AttachmentIndexRecord index;
  };

  // Stores the bytes of one write of the sink.
  void Write(std::span<const std::byte> bytes);
  // Stores what the record contains. `piece` is the write that contains the record.
  void AddRecord(const RawRecord& record, const Piece& piece) GSV_REQUIRES(mutex_);
  void AddChunk(const ChunkRecord& chunk, std::span<const std::byte> indexes, const Piece& piece)
      GSV_REQUIRES(mutex_);
  // Drops the oldest chunks until all pieces are within the capacity.
  void Shrink() GSV_REQUIRES(mutex_);
  // Drops each attachment that a later attachment with the same name has replaced before the start
  // of the first kept chunk.
  void DropReplaced() GSV_REQUIRES(mutex_);

  const std::size_t capacity_;  // maximum size of all kept pieces, bytes
  mutable base::Mutex mutex_;
  std::uint64_t offset_ GSV_GUARDED_BY(mutex_) = 0;  // offset of the next write
  std::size_t size_ GSV_GUARDED_BY(mutex_) = 0;      // number of bytes of all kept pieces
  // number of written messages, including dropped ones
  std::uint64_t messages_ GSV_GUARDED_BY(mutex_) = 0;
  std::deque<Chunk> chunks_ GSV_GUARDED_BY(mutex_);
  std::vector<Attached> attachments_ GSV_GUARDED_BY(mutex_);
  std::vector<std::pair<Piece, MetadataIndexRecord>> metadata_ GSV_GUARDED_BY(mutex_);
  std::map<std::uint16_t, SchemaRecord> schemas_ GSV_GUARDED_BY(mutex_);
  Channels channels_ GSV_GUARDED_BY(mutex_);
};

}  // namespace gsv::recording
