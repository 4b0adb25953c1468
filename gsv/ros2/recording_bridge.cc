#include "gsv/ros2/recording_bridge.h"

#include <map>
#include <optional>
#include <set>
#include <string_view>
#include <thread>
#include <utility>

#include "gsv/base/log.h"
#include "gsv/base/mutex.h"
#include "gsv/messages/rosgraph_msgs.h"
#include "gsv/messages/time.h"
#include "gsv/recording/mcap/mcap_reader.h"
#include "gsv/recording/reading/newest_messages.h"
#include "gsv/ros2/graph.h"
#include "gsv/ros2/message_source.h"
#include "gsv/ros2/names.h"

namespace gsv::ros2 {
namespace {

// The period at which the thread checks the position of the replay, in wall-clock time.
constexpr std::chrono::milliseconds kTick{5};
constexpr std::size_t kMaxTopics = 1000;
constexpr std::string_view kClockTopic = "/clock";

// Whether the user has moved the position of the replay. `advance` is the change of the position
// since the last tick. It is then negative, or more than half a second of replay at `speed` and one
// second more. A busy machine can delay a tick, but hardly so long.
bool IsJump(base::SimTime advance, double speed) {
  return advance < base::SimTime(0) || base::ToSeconds(advance) > 1 + speed / 2;
}

class FileBridge final : public RecordingBridge {
 public:
  FileBridge(dds::Participant& participant, Distro distro,
             std::unique_ptr<recording::McapReader> reader, std::function<Position()> position)
      : reader_(std::move(reader)),
        position_(std::move(position)),
        graph_(participant, distro),
        node_(participant, distro, "/", "gsv", {}) {
    clock_ = node_.Advertise(kClockTopic, "rosgraph_msgs/msg/Clock", kClockQos);
    Advertise();
    graph_.Publish({node_.info()});
    thread_ = std::thread([this] { Run(); });
  }
  ~FileBridge() override {
    {
      const base::MutexLock lock(mutex_);
      is_stopping_ = true;
    }
    changed_.notify_all();
    thread_.join();
  }

 private:
  void Advertise();
  void Run();
  void PlayTo(base::SimTime time);
  void JumpTo(base::SimTime time);
  void ReadNext();

  const std::unique_ptr<recording::McapReader> reader_;
  const std::function<Position()> position_;
  Graph graph_;
  Node node_;
  dds::Writer* clock_ = nullptr;
  std::map<std::uint16_t, dds::Writer*> writers_;  // writers by the ids of their channels
  std::set<std::uint16_t> latched_;                // the channels whose newest message stays valid
  std::optional<recording::MessageCursor> cursor_;
  std::optional<recording::MessageRecord> next_;  // the next message to publish
  base::Mutex mutex_;
  base::ConditionVariable changed_;
  bool is_stopping_ GSV_GUARDED_BY(mutex_) = false;
  std::thread thread_;
};

void FileBridge::Advertise() {
  const recording::Summary& summary = reader_->summary();
  std::set<std::string> taken{std::string(kClockTopic)};
  std::size_t left_out = 0;
  for (const auto& [id, channel] : summary.channels) {
    const auto schema = summary.schemas.find(channel.schema_id);
    const std::string topic = PublishedTopic(channel.topic);
    const bool is_cdr = channel.message_encoding == "cdr" && schema != summary.schemas.end() &&
                        schema->second.encoding == "ros2msg";
    if (!is_cdr || topic.empty() || taken.size() > kMaxTopics || !taken.insert(topic).second) {
      left_out += channel.topic == kClockTopic ? 0 : 1;
      continue;
    }
    const bool is_latched = topic.ends_with("/tf_static") || topic.ends_with("/robot_description");
    writers_[id] =
        node_.Advertise(topic, schema->second.name, is_latched ? kLatchedQos : kDefaultQos);
    if (is_latched && writers_[id] != nullptr) latched_.insert(id);
  }
  if (left_out > 0) spdlog::warn("{} topics of the recording are not published to ROS 2", left_out);
}

void FileBridge::Run() {
  base::SimTime last = position_().time;
  JumpTo(last);
  bool has_begun = false;
  base::MutexLock lock(mutex_);
  while (!changed_.wait_for(lock, kTick, [this]() GSV_REQUIRES(mutex_) { return is_stopping_; })) {
    lock.unlock();
    const Position now = position_();
    if (IsJump(now.time - last, now.speed)) JumpTo(now.time);
    if (now.time != last || !has_begun) {
      has_begun = true;
      Send(messages::rosgraph_msgs::Clock{messages::ToMessage(now.time)}, clock_);
      PlayTo(now.time);
      last = now.time;
    }
    lock.lock();
  }
}

void FileBridge::JumpTo(base::SimTime time) {
  next_.reset();
  // The messages at `time` follow from the cursor.
  if (!latched_.empty()) {
    const auto newest = recording::FindNewestMessages(*reader_, time - base::SimTime(1));
    for (const auto& [id, message] : newest.by_channel) {
      if (latched_.contains(id)) writers_[id]->Write(message.data);
    }
  }
  cursor_.emplace(reader_->Messages(time));
  ReadNext();
}

void FileBridge::PlayTo(base::SimTime time) {
  while (next_ && next_->log_time <= time) {
    const auto writer = writers_.find(next_->channel_id);
    const bool is_wanted = writer != writers_.end() && writer->second != nullptr;
    if (is_wanted) writer->second->Write(next_->data);
    ReadNext();
  }
}

// Reads the next message. Skips damaged parts of the file.
void FileBridge::ReadNext() {
  for (;;) {
    auto record = cursor_->Next();
    if (!record) continue;
    next_ = *std::move(record);
    return;
  }
}

}  // namespace

base::Result<std::unique_ptr<RecordingBridge>> RecordingBridge::Start(
    dds::Participant& participant, Distro distro, const std::string& path,
    std::function<Position()> position) {
  auto reader = recording::McapReader::Open(path);
  if (!reader) return base::Fail(reader.error());
  return std::make_unique<FileBridge>(participant, distro, *std::move(reader), std::move(position));
}

std::string PublishedTopic(const std::string& recorded) {
  std::string topic;
  std::string_view rest = recorded;
  while (!rest.empty()) {
    const std::string_view part = rest.substr(0, rest.find('/'));
    rest.remove_prefix(std::min(rest.size(), part.size() + 1));
    if (!part.empty()) topic += "/" + RosName(part);
  }
  return topic;
}

}  // namespace gsv::ros2
