#include "gsv/recording/mcap/mcap_writer.h"

#include <algorithm>
#include <limits>
#include <optional>

#include "gsv/base/check.h"
#include "gsv/base/log.h"
#include "gsv/recording/mcap/background_sync.h"

namespace gsv::recording {
namespace {

// Writes a record that is no message. Append() has encoded it.
void WriteOther(McapFileWriter& file, std::span<const std::byte> encoded) {
  while (const std::optional<RawRecord> record = TakeRecord(encoded)) {
    switch (record->opcode) {
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
      block_size_(std::min(options_.file.chunk_size, options_.queue_size)),
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
  Bytes records;
  if (type == schemas_.end()) {
    const auto id = static_cast<std::uint16_t>(schemas_.size() + 1);
    type =
        schemas_.insert(type, SchemaRecord{id, std::string(schema.name),
                                           std::string(schema.encoding), std::string(schema.text)});
    Append(records, *type);
  }
  ChannelRecord channel{static_cast<ChannelId>(channels_.size()), type->id, topic, "cdr", {}};
  if (!options.reproducible) channel.metadata["reproducible"] = "false";
  Append(records, channel);
  AddOther(std::move(records));
  sequences_.push_back(0);
  return channels_.emplace(topic, std::move(channel)).first->second.id;
}

void McapWriter::Write(std::span<const Message> messages) {
  if (failed_) return;
  base::MutexLock lock(mutex_);
  for (const Message& message : messages) Enqueue(message, lock);
}

void McapWriter::Enqueue(const Message& message, base::MutexLock& lock) {
  GSV_CHECK(message.channel < sequences_.size());
  if (queued_ >= options_.queue_size && options_.when_full == WhenFull::kDrop) {
    // The gap in the sequence numbers shows readers that a message was dropped.
    ++sequences_[message.channel];
    ++progress_.dropped;
    return;
  }
  if (!WaitForSpace(lock)) return;
  if (blocks_.empty() || blocks_.back().size() >= block_size_) AddBlock();
  Bytes& block = blocks_.back();
  const std::size_t before = block.size();
  Append(block, MessageRecord{message.channel, sequences_[message.channel]++, message.log_time,
                              message.log_time, message.data});
  ++progress_.messages;
  CountQueued(block.size() - before);
}

void McapWriter::Attach(const AttachmentRecord& attachment) {
  Bytes record;
  Append(record, attachment);
  EnqueueOther(std::move(record));
}

void McapWriter::AddMetadata(const MetadataRecord& metadata) {
  Bytes record;
  Append(record, metadata);
  EnqueueOther(std::move(record));
}

void McapWriter::EnqueueOther(Bytes record) {
  base::MutexLock lock(mutex_);
  if (WaitForSpace(lock)) AddOther(std::move(record));
}

void McapWriter::AddOther(Bytes record) {
  const std::size_t size = record.size();
  others_.push_back(std::move(record));
  CountQueued(size);
}

void McapWriter::AddBlock() {
  if (empty_blocks_.empty()) {
    blocks_.emplace_back().reserve(block_size_ + block_size_ / 16);
  } else {
    blocks_.push_back(std::move(empty_blocks_.back()));
    empty_blocks_.pop_back();
  }
}

std::vector<Bytes> McapWriter::TakeBlocks(bool all) {
  std::vector<Bytes> blocks = std::exchange(blocks_, {});
  if (!all && !blocks.empty() && blocks.back().size() < block_size_) {
    blocks_.push_back(std::move(blocks.back()));
    blocks.pop_back();
  }
  queued_ = blocks_.empty() ? 0 : blocks_.back().size();
  return blocks;
}

// Waits until the queue has space. Returns false if the recording has ended.
bool McapWriter::WaitForSpace(base::MutexLock& lock) {
  const auto has_room = [&]() GSV_REQUIRES(mutex_) {
    return queued_ < options_.queue_size || closing_ || !status_;
  };
  // Checks for space before wait_for(), which would read the clock. Usually there is space.
  if (!has_room() && !room_.wait_for(lock, options_.wait_limit, has_room)) {
    EndWith({base::ErrorCode::kTimeout,
             "the recording's disk does not keep up; record fewer topics or to a faster disk",
             {}});
  }
  return status_.has_value() && !closing_;
}

void McapWriter::CountQueued(std::size_t size) {
  if (oldest_ == std::chrono::steady_clock::time_point{}) {
    oldest_ = std::chrono::steady_clock::now();
  }
  const bool was_short = queued_ < block_size_;
  queued_ += size;
  if (was_short && queued_ >= block_size_) work_.notify_one();
}

void McapWriter::EndWith(base::Error error) {
  if (status_) status_ = base::Fail(std::move(error));
  failed_ = true;
  blocks_.clear();
  others_.clear();
  queued_ = 0;
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

void McapWriter::Reuse(Bytes block) {
  if (block.capacity() > 2 * block_size_) return;  // it contained a large message
  block.clear();
  const base::MutexLock lock(mutex_);
  empty_blocks_.push_back(std::move(block));
}

void McapWriter::Run() {
  McapFileWriter file(*sink_, options_.file);
  std::optional<BackgroundSync> disk(*sink_);
  for (bool closing = false; !closing;) {
    std::vector<Bytes> blocks, others;
    bool flush = false;
    std::uint64_t dropped = 0;
    {
      base::MutexLock lock(mutex_);
      progress_.bytes = file.bytes_written();
      if (!file.status() && status_) EndWith(file.status().error());
      if (const base::Status synced = disk->status(); !synced && status_) EndWith(synced.error());
      work_.wait(lock, [&]() GSV_REQUIRES(mutex_) {
        return flush_ || closing_ || queued_ >= block_size_;
      });
      flush = std::exchange(flush_, false);
      closing = closing_;
      others = std::exchange(others_, {});
      blocks = TakeBlocks(flush || closing);
      dropped = progress_.dropped;
    }
    room_.notify_all();
    for (const Bytes& record : others) WriteOther(file, record);
    for (Bytes& block : blocks) {
      file.WriteChunk(block);
      Reuse(std::move(block));
    }
    if (flush && file.status()) disk->RequestSync();
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
