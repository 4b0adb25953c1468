#include "gsv/recording/mcap/mcap_writer.h"

#include <algorithm>
#include <limits>
#include <optional>

#include "gsv/base/check.h"
#include "gsv/base/log.h"
#include "gsv/recording/mcap/background_sync.h"

namespace gsv::recording {
namespace {

// The writer's thread is woken only when this number of bytes is queued, not for each message.
constexpr std::size_t kWorthWaking = std::size_t{256} << 10;

// Writes the records in `batch` one by one. Append() has encoded them one after the other.
void WriteBatch(McapFileWriter& file, std::span<const std::byte> batch) {
  const std::span<const std::byte> all = batch;
  while (const std::optional<RawRecord> record = TakeRecord(batch)) {
    switch (record->opcode) {
      case Opcode::kMessage: {
        const MessageHead head = ReadMessageHead(record->content);
        const std::size_t size = kRecordHeaderSize + record->content.size();
        const std::size_t start = all.size() - batch.size() - size;
        file.WriteEncoded(head.channel_id, head.log_time, all.subspan(start, size));
        break;
      }
      case Opcode::kSchema:
        file.AddSchema(*Parse<SchemaRecord>(record->content));
        break;
      case Opcode::kChannel:
        file.AddChannel(*Parse<ChannelRecord>(record->content));
        break;
      case Opcode::kAttachment:
        file.Attach(*Parse<AttachmentRecord>(record->content));
        break;
      case Opcode::kMetadata:
        file.AddMetadata(*Parse<MetadataRecord>(record->content));
        break;
      default:
        GSV_CHECK(false);
    }
  }
}

bool SameType(const SchemaRecord& record, const messages::Schema& schema) {
  return record.name == schema.name && record.encoding == schema.encoding &&
         record.data == schema.text;
}

}  // namespace

base::Result<std::unique_ptr<McapWriter>> McapWriter::Create(const std::string& path,
                                                             WriterOptions options) {
  auto sink = FileSink::Create(path, options.replace);
  if (!sink) return base::Fail(std::move(sink.error()));
  return std::make_unique<McapWriter>(std::move(*sink), std::move(options));
}

McapWriter::McapWriter(std::unique_ptr<ByteSink> sink, WriterOptions options)
    : options_(std::move(options)),
      wake_at_(std::min(kWorthWaking, options_.queue_size)),
      sink_(std::move(sink)),
      thread_([this] { Run(); }) {}

McapWriter::~McapWriter() {
  if (!thread_.joinable()) return;
  if (const base::Status status = Close(); !status) {
    spdlog::error("the recording is incomplete: {}", status.error().Sentence());
  }
}

base::Result<ChannelId> McapWriter::AddChannel(const std::string& topic,
                                               const messages::Schema& schema,
                                               const ChannelOptions& options) {
  const base::MutexLock lock(mutex_);
  const auto same_type = [&](const SchemaRecord& each) { return SameType(each, schema); };
  auto type = std::find_if(schemas_.begin(), schemas_.end(), same_type);
  if (const auto known = channels_.find(topic); known != channels_.end()) {
    if (type != schemas_.end() && type->id == known->second.schema_id) return known->second.id;
    return base::Fail(
        base::ErrorCode::kInvalidArgument,
        "the topic is recorded already, with another type than " + std::string(schema.name), topic);
  }
  if (channels_.size() == std::numeric_limits<ChannelId>::max()) {
    return base::Fail(base::ErrorCode::kInvalidArgument,
                      "a recording may have at most 65,535 topics; record fewer", topic);
  }
  const std::size_t before = queued();
  if (type == schemas_.end()) {
    const auto id = static_cast<std::uint16_t>(schemas_.size() + 1);
    type =
        schemas_.insert(type, SchemaRecord{id, std::string(schema.name),
                                           std::string(schema.encoding), std::string(schema.text)});
    Append(queue_, *type);
  }
  ChannelRecord channel{static_cast<ChannelId>(channels_.size()), type->id, topic, "cdr", {}};
  if (!options.reproducible) channel.metadata["reproducible"] = "false";
  Append(queue_, channel);
  WakeWriter(before);
  sequences_.push_back(0);
  return channels_.emplace(topic, std::move(channel)).first->second.id;
}

void McapWriter::Write(ChannelId channel, base::SimTime log_time, std::span<const std::byte> data) {
  if (failed_) return;
  base::MutexLock lock(mutex_);
  GSV_CHECK(channel < sequences_.size());
  if (queued() >= options_.queue_size && options_.when_full == WhenFull::kDrop) {
    // The gap in the sequence numbers shows readers that a message was dropped.
    ++sequences_[channel];
    ++progress_.dropped;
    return;
  }
  if (!WaitForSpace(lock)) return;
  const std::size_t before = queued();
  Append(queue_, MessageRecord{channel, sequences_[channel]++, log_time, log_time, data});
  ++progress_.messages;
  WakeWriter(before);
}

void McapWriter::Attach(const AttachmentRecord& attachment) {
  Bytes record;
  Append(record, attachment);
  EnqueueWhole(std::move(record));
}

void McapWriter::AddMetadata(const MetadataRecord& metadata) {
  Bytes record;
  Append(record, metadata);
  EnqueueWhole(std::move(record));
}

void McapWriter::EnqueueWhole(Bytes record) {
  base::MutexLock lock(mutex_);
  if (!WaitForSpace(lock)) return;
  const std::size_t before = queued();
  whole_size_ += record.size();
  whole_.push_back(std::move(record));
  WakeWriter(before);
}

// Waits until the queue has space. Returns false if the recording has ended.
bool McapWriter::WaitForSpace(base::MutexLock& lock) {
  const auto has_room = [&]() GSV_REQUIRES(mutex_) {
    return queued() < options_.queue_size || closing_ || !status_;
  };
  // Checks for space before wait_for(), which would read the clock. Usually there is space.
  if (!has_room() && !room_.wait_for(lock, options_.wait_limit, has_room)) {
    EndWith({base::ErrorCode::kTimeout,
             "the recording's disk does not keep up; record fewer topics or to a faster disk",
             {}});
  }
  return status_.has_value() && !closing_;
}

// Wakes the writer's thread if the queue has just become long. `before` is the size of the queue
// before the new record.
void McapWriter::WakeWriter(std::size_t before) {
  if (oldest_ == std::chrono::steady_clock::time_point{}) {
    oldest_ = std::chrono::steady_clock::now();
  }
  if (before < wake_at_ && queued() >= wake_at_) work_.notify_one();
}

void McapWriter::EndWith(base::Error error) {
  if (status_) status_ = base::Fail(std::move(error));
  failed_ = true;
  queue_.clear();
  whole_.clear();
  whole_size_ = 0;
  room_.notify_all();
}

void McapWriter::FlushIfOlderThan(std::chrono::steady_clock::duration age) {
  const base::MutexLock lock(mutex_);
  const bool has_any = oldest_ != std::chrono::steady_clock::time_point{};
  if (!has_any || std::chrono::steady_clock::now() - oldest_ < age) return;
  flush_ = true;
  oldest_ = {};
  work_.notify_one();
}

base::Status McapWriter::Close() {
  {
    const base::MutexLock lock(mutex_);
    closing_ = true;
  }
  work_.notify_one();
  room_.notify_all();
  std::call_once(joined_, [this] { thread_.join(); });
  return status();
}

base::Status McapWriter::status() const {
  const base::MutexLock lock(mutex_);
  return status_;
}

McapWriter::Progress McapWriter::progress() const {
  const base::MutexLock lock(mutex_);
  return progress_;
}

void McapWriter::Run() {
  McapFileWriter file(*sink_, options_.file);
  std::optional<BackgroundSync> disk(*sink_);
  Bytes batch;
  std::vector<Bytes> whole;
  for (bool closing = false; !closing;) {
    bool flush = false;
    std::uint64_t dropped = 0;
    {
      base::MutexLock lock(mutex_);
      progress_.bytes = file.bytes_written();
      if (!file.status() && status_) EndWith(file.status().error());
      if (const base::Status synced = disk->status(); !synced && status_) EndWith(synced.error());
      work_.wait(lock,
                 [&]() GSV_REQUIRES(mutex_) { return flush_ || closing_ || queued() >= wake_at_; });
      batch.clear();
      std::swap(batch, queue_);
      whole = std::exchange(whole_, {});
      whole_size_ = 0;
      flush = std::exchange(flush_, false);
      closing = closing_;
      dropped = progress_.dropped;
    }
    room_.notify_all();
    for (const Bytes& record : whole) WriteBatch(file, record);
    WriteBatch(file, batch);
    if (flush && file.CloseChunk()) disk->RequestSync();
    if (closing && dropped > 0) {
      file.AddMetadata({"gsv.recording", {{"dropped_messages", std::to_string(dropped)}}});
    }
  }
  disk.reset();
  const base::Status status = file.Close();
  const base::MutexLock lock(mutex_);
  progress_.bytes = file.bytes_written();
  if (!status) EndWith(status.error());
}

}  // namespace gsv::recording
