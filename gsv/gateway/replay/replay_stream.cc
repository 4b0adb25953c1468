#include "gsv/gateway/replay/replay_stream.h"

#include <utility>
#include <vector>

#include "gsv/gateway/foxglove/channels.h"
#include "gsv/gateway/live/sensor_topics.h"
#include "gsv/messages/time.h"
#include "gsv/presentation/run_messages.h"
#include "gsv/recording/reading/newest_messages.h"

namespace gsv::gateway {
namespace {

namespace topics = presentation::topics;

constexpr double kReplayStatusRate = 5;  // Hz
constexpr int kMaxWarnings = 10;

foxglove::ServerInfo InfoOf(const std::string& name, const recording::Summary& summary) {
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  return {
      "gsv replay: " + name,
      {"time"},
      {{"simulation", name}},
      std::to_string(std::chrono::duration_cast<std::chrono::microseconds>(now).count()),
      foxglove::TimeRange{base::NanosecondsOf(summary.start), base::NanosecondsOf(summary.end)}};
}

// Whether the topic concerns the whole simulation, not one robot. These topics are advertised
// first, so that the limit on topics does not exclude them.
bool IsCommon(const std::string& topic) {
  return topic.starts_with("/gsv/") || presentation::FindTopic(topic) != nullptr;
}

// Returns the robot of a topic: "pebble" for "/pebble/camera". Topics of the whole simulation have
// no robot: "/clock" gives an empty text, and "/gsv/poses" gives "gsv".
std::string RobotOf(const std::string& topic) {
  const std::size_t end = topic.find('/', 1);
  return end == std::string::npos ? std::string() : topic.substr(1, end - 1);
}

template <typename Message>
Message DecodedOrEmpty(const SharedBytes& bytes) {
  const auto message =
      messages::Decode<Message>(std::as_bytes(std::span(bytes.data(), bytes.size())));
  return message ? *message : Message{};
}

}  // namespace

ReplayStream::ReplayStream(const recording::McapReader& reader, const std::string& name,
                           std::function<void()> on_demand, std::shared_ptr<Operations> operations)
    : reader_(reader),
      hub_(std::make_shared<Hub>(InfoOf(name, reader.summary()), std::move(on_demand),
                                 std::move(operations))),
      status_pacing_(kReplayStatusRate) {
  const auto own = hub_->Advertise({ChannelFor(topics::kClock), ChannelFor(topics::kStatus)});
  clock_channel_ = own[0];
  status_channel_ = own[1];
  AdvertiseFirst();
}

ReplayStream::Kind ReplayStream::KindOf(const std::string& topic) {
  const presentation::Topic* const row = presentation::FindTopic(topic);
  if (topic == topics::kPoses.name) return Kind::kPoses;
  if (row == nullptr || row->replay == presentation::Replay::kNewest) return Kind::kPlain;
  if (row->replay == presentation::Replay::kEach) return Kind::kEvents;
  return topic == topics::kStatus.name ? Kind::kStatus : Kind::kClock;
}

void ReplayStream::AdvertiseFirst() {
  const recording::Summary& summary = reader_.summary();
  std::vector<std::uint16_t> ids;
  for (const bool common : {true, false}) {
    for (const auto& [id, channel] : summary.channels) {
      const auto schema = summary.schemas.find(channel.schema_id);
      const bool is_ours = channel.message_encoding == "cdr" && schema != summary.schemas.end() &&
                           schema->second.encoding == "ros2msg";
      if (!is_ours || IsCommon(channel.topic) != common) continue;
      Track& track = tracks_[id];
      track.kind = KindOf(channel.topic);
      const bool is_own = track.kind == Kind::kStatus || track.kind == Kind::kClock;
      if (!is_own && ids.size() < kMaxSensorTopics) ids.push_back(id);
    }
  }
  Advertise(ids);
}

void ReplayStream::AdvertiseWanted() {
  if (!wanted_.TakeRequests()) return;
  EvictUnsubscribed();
  std::vector<std::uint16_t> ids;
  for (auto& [id, track] : tracks_) {
    const bool is_left_out = track.kind == Kind::kPlain && track.channel == 0;
    if (!is_left_out || !wanted_.Contains(RobotOf(TopicOf(id)))) continue;
    track.is_wanted = true;
    ids.push_back(id);
  }
  Advertise(ids);
}

void ReplayStream::EvictUnsubscribed() {
  const std::set<std::string> forgotten =
      wanted_.EvictUnsubscribed([this] { return SubscribedRobots(); });
  std::vector<foxglove::ChannelId> gone;
  for (auto& [id, track] : tracks_) {
    if (!track.is_wanted || !forgotten.contains(RobotOf(TopicOf(id)))) continue;
    gone.push_back(std::exchange(track.channel, 0));
    track.is_wanted = false;
  }
  hub_->Unadvertise(gone);
}

std::set<std::string> ReplayStream::SubscribedRobots() const {
  std::set<std::string> robots;
  for (const auto& [id, track] : tracks_) {
    if (track.is_wanted && hub_->IsSubscribed(track.channel)) robots.insert(RobotOf(TopicOf(id)));
  }
  return robots;
}

const std::string& ReplayStream::TopicOf(std::uint16_t id) const {
  return reader_.summary().channels.at(id).topic;
}

void ReplayStream::Advertise(const std::vector<std::uint16_t>& ids) {
  const recording::Summary& summary = reader_.summary();
  std::vector<foxglove::Channel> channels;
  for (const std::uint16_t id : ids) {
    const auto& channel = summary.channels.at(id);
    const auto& schema = summary.schemas.at(channel.schema_id);
    channels.push_back(
        {0, channel.topic, channel.message_encoding, schema.name, schema.encoding, schema.data});
  }
  const auto advertised = hub_->Advertise(std::move(channels));
  for (std::size_t i = 0; i < ids.size(); ++i) tracks_[ids[i]].channel = advertised[i];
}

void ReplayStream::JumpTo(base::SimTime time) {
  has_jumped_ = true;
  for (auto& [id, track] : tracks_) {
    track.latest.reset();
    track.is_fresh = false;
  }
  recording::NewestMessages newest = recording::FindNewestMessages(reader_, time);
  for (const base::Problem& problem : newest.problems) Warn(problem.Sentence());
  for (auto& [id, message] : newest.by_channel) Keep(id, message.log_time, std::move(message.data));
  cursor_.reset();
  cursor_.emplace(reader_.Messages(time + base::SimTime(1)));
  ReadNext();
}

void ReplayStream::PlayTo(base::SimTime time) {
  while (next_ && next_->log_time <= time) {
    const Track* track = Keep(next_->channel_id, next_->log_time,
                              recording::Bytes(next_->data.begin(), next_->data.end()));
    if (track != nullptr && track->kind == Kind::kEvents) {
      hub_->Publish(track->channel, *track->latest, Hub::Audience::kEstablished);
    }
    ReadNext();
  }
}

void ReplayStream::ReadNext() {
  for (;;) {
    const auto next = cursor_->Next();
    if (next) {
      next_ = *next;
      return;
    }
    Warn(next.error().Sentence());  // the next call of Next() continues after the damage
  }
}

const ReplayStream::Track* ReplayStream::Keep(std::uint16_t id, base::SimTime time,
                                              recording::Bytes data) {
  const auto found = tracks_.find(id);
  if (found == tracks_.end()) return nullptr;
  Track& track = found->second;
  track.latest = Hub::Message{base::NanosecondsOf(time), SharedBytes(std::move(data))};
  track.is_fresh = track.kind != Kind::kEvents;
  if (track.kind == Kind::kStatus || track.kind == Kind::kPoses) {
    const base::MutexLock lock(mutex_);
    (track.kind == Kind::kStatus ? status_ : poses_) = track.latest->payload;
  }
  return &track;
}

void ReplayStream::Publish(base::SimTime time, simulation::Phase phase, WallTime now,
                           const std::function<simulation::SimulationStatus()>& status) {
  AdvertiseWanted();
  hub_->PublishChanges(std::exchange(has_jumped_, false));
  const bool has_moved = published_time_ != time;
  // While the replay plays, the status is sent at a limited rate. While it is paused, every change
  // is sent at once.
  const bool is_paced = phase == simulation::Phase::kRunning;
  const bool is_due =
      published_phase_ != phase || (has_moved && (!is_paced || status_pacing_.IsDue(now)));
  if (has_moved) hub_->PublishTime(base::NanosecondsOf(time));
  PublishOwn(clock_channel_, has_moved, time,
             [&] { return Encoded(messages::rosgraph_msgs::Clock{messages::ToMessage(time)}); });
  PublishOwn(status_channel_, is_due, time,
             [&] { return Encoded(presentation::StatusMessage(status())); });
  if (is_due) status_pacing_.Done(now);
  published_time_ = time;
  published_phase_ = phase;
  for (auto& [id, track] : tracks_) Publish(track);
}

void ReplayStream::Publish(Track& track) {
  if (track.channel == 0 || !track.latest || !hub_->IsSubscribed(track.channel)) return;
  if (std::exchange(track.is_fresh, false)) return hub_->Publish(track.channel, *track.latest);
  hub_->Welcome(track.channel, {&*track.latest, 1});
}

void ReplayStream::PublishOwn(foxglove::ChannelId channel, bool is_due, base::SimTime time,
                              const std::function<SharedBytes()>& encode) {
  if (!hub_->IsSubscribed(channel) || (!is_due && !hub_->HasNewSubscribers(channel))) return;
  const Hub::Message message{base::NanosecondsOf(time), encode()};
  if (is_due) return hub_->Publish(channel, message);
  hub_->Welcome(channel, {&message, 1});
}

void ReplayStream::Warn(const std::string& sentence) {
  if (++warnings_ > kMaxWarnings) return;
  hub_->SendStatus(foxglove::StatusLevel::kWarning, sentence);
}

messages::gsv_msgs::SimulationStatus ReplayStream::recorded_status() const {
  const base::MutexLock lock(mutex_);
  return DecodedOrEmpty<messages::gsv_msgs::SimulationStatus>(status_);
}

messages::gsv_msgs::Poses ReplayStream::recorded_poses() const {
  const base::MutexLock lock(mutex_);
  return DecodedOrEmpty<messages::gsv_msgs::Poses>(poses_);
}

}  // namespace gsv::gateway
