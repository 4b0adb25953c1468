// Records messages to an MCAP file on a separate thread.
//
// Producers put messages into a bounded queue. The writer's thread compresses them and writes the
// file. Producers wait for the disk only if the queue is full, see WhenFull. A failing disk ends
// the recording, not the program: status() has the reason, and later messages are discarded.
//
// Threads  every member may be called from any thread, at any moment.
// Time     log times are simulated. The wall-clock time decides only when the file is flushed, and
//          how long a producer waits for the disk.
#pragma once

#include <atomic>
#include <chrono>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

#include "gsv/base/error.h"
#include "gsv/base/mutex.h"
#include "gsv/base/sim_time.h"
#include "gsv/messages/schema.h"
#include "gsv/recording/mcap/mcap_file_writer.h"

namespace gsv::recording {

// The handling of a message if the queue is full.
enum class WhenFull {
  kDrop,  // drop and count the message; for runs in real time
  kWait,  // the producer waits for the disk; for runs in lockstep
};

struct WriterOptions {
  FileOptions file{};
  bool replace = false;  // whether to replace an existing file
  WhenFull when_full = WhenFull::kDrop;
  std::size_t queue_size = std::size_t{64} << 20;  // maximum size of the queue, bytes
  // If a producer waits longer than this for the disk, the recording ends.
  std::chrono::milliseconds wait_limit{10'000};
};

// The options of a channel. If its messages depend on the wall clock, the channel's metadata has
// the value "false" for "reproducible", and the messages are not part of the content hash.
struct ChannelOptions {
  bool reproducible = true;
};

// Identifies a channel of one McapWriter. AddChannel() returns it.
using ChannelId = std::uint16_t;

class McapWriter {
 public:
  // Creates the file and starts the thread.
  [[nodiscard]] static base::Result<std::unique_ptr<McapWriter>> Create(const std::string& path,
                                                                        WriterOptions options = {});
  McapWriter(std::unique_ptr<ByteSink> sink, WriterOptions options);
  // Closes the recording. Logs an error unless Close() has returned it.
  ~McapWriter();
  McapWriter(const McapWriter&) = delete;
  McapWriter& operator=(const McapWriter&) = delete;

  // Adds or finds the channel of a topic. Returns kInvalidArgument if the topic has another schema,
  // or if there are 65,535 channels.
  [[nodiscard]] base::Result<ChannelId> AddChannel(const std::string& topic,
                                                   const messages::Schema& schema,
                                                   const ChannelOptions& options = {});
  // A message to record.
  struct Message {
    ChannelId channel = 0;
    base::SimTime log_time{};         // must not be negative
    std::span<const std::byte> data;  // a CDR message of the channel's type
  };
  // Records messages, whose data is copied. Messages of one channel keep their order. To pass
  // several messages at once saves time.
  void Write(std::span<const Message> messages);
  void Write(ChannelId channel, base::SimTime log_time, std::span<const std::byte> data) {
    const Message message{channel, log_time, data};
    Write({&message, 1});
  }

  // Attach() adds a file to the recording, AddMetadata() adds named values. Files and values are
  // never dropped: the caller waits while the queue is full.
  void Attach(const AttachmentRecord& attachment);
  void AddMetadata(const MetadataRecord& metadata);

  // Requests a flush on the writer's thread if the oldest message that is not on disk is older than
  // `age`. The owner calls this a few times per second.
  void FlushIfOlderThan(std::chrono::steady_clock::duration age);

  // Writes the queue and the summary, and waits for the disk. Later calls do nothing.
  base::Status Close();

  // The error that ended the recording early, or success.
  base::Status status() const;
  bool failed() const { return failed_; }

  struct Progress {
    std::uint64_t messages = 0;  // number of accepted messages
    std::uint64_t dropped = 0;   // number of messages that were dropped because the queue was full
    std::uint64_t bytes = 0;     // number of bytes written to the file
  };
  Progress progress() const;

 private:
  // Enqueues a message, or drops it.
  void Enqueue(const Message& message, base::MutexLock& lock) GSV_REQUIRES(mutex_);
  // Enqueues another record. Waits for space; drops the record only after an error.
  void EnqueueOther(Bytes record);
  void AddOther(Bytes record) GSV_REQUIRES(mutex_);
  // Adds an empty block to the queue.
  void AddBlock() GSV_REQUIRES(mutex_);
  // Updates queued_ after `size` bytes were enqueued. Wakes the writer's thread if a block is
  // complete.
  void CountQueued(std::size_t size) GSV_REQUIRES(mutex_);
  // Keeps the memory of a written block.
  void Reuse(Bytes block);
  // Waits until the queue has space. Returns false if the recording has ended.
  bool WaitForSpace(base::MutexLock& lock) GSV_REQUIRES(mutex_);
  // Ends the recording early, and discards the queue.
  void EndWith(base::Error error) GSV_REQUIRES(mutex_);
  // Removes all complete blocks from the queue. With `all`, also the last one, if it is incomplete.
  std::vector<Bytes> TakeBlocks(bool all) GSV_REQUIRES(mutex_);
  // The function of thread_: writes the queue to the sink until Close().
  void Run();

  const WriterOptions options_;
  // The size at which a block of messages is complete, and at which the writer's thread is woken,
  // in bytes.
  const std::size_t block_size_;
  const std::unique_ptr<ByteSink> sink_;

  mutable base::Mutex mutex_;
  // Notified when there is work for the writer's thread.
  base::ConditionVariable work_;
  base::ConditionVariable room_;  // notified when producers may continue
  // The queue: blocks of encoded messages, each of which becomes a chunk of the file, and other
  // encoded records, which are written before the messages. The last block may be incomplete.
  std::vector<Bytes> blocks_ GSV_GUARDED_BY(mutex_);
  std::vector<Bytes> others_ GSV_GUARDED_BY(mutex_);
  std::size_t queued_ GSV_GUARDED_BY(mutex_) = 0;           // size of the queue, in bytes
  std::vector<Bytes> empty_blocks_ GSV_GUARDED_BY(mutex_);  // written blocks, for reuse
  bool flush_ GSV_GUARDED_BY(mutex_) = false;    // whether the thread must flush the sink next
  bool closing_ GSV_GUARDED_BY(mutex_) = false;  // whether Close() was called
  // Wall-clock time at which the oldest message that is not flushed was queued; zero if there is
  // none.
  std::chrono::steady_clock::time_point oldest_ GSV_GUARDED_BY(mutex_){};
  base::Status status_ GSV_GUARDED_BY(mutex_);
  Progress progress_ GSV_GUARDED_BY(mutex_);
  std::map<std::string, ChannelRecord> channels_ GSV_GUARDED_BY(mutex_);  // channels by topic
  std::vector<SchemaRecord> schemas_ GSV_GUARDED_BY(mutex_);
  // The next sequence number, by channel.
  std::vector<std::uint32_t> sequences_ GSV_GUARDED_BY(mutex_);

  std::atomic<bool> failed_ = false;  // whether an error has ended the recording
  std::once_flag joined_;             // Close() has joined thread_
  std::thread thread_;                // executes Run()
};

}  // namespace gsv::recording
