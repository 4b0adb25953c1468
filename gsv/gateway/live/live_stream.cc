#include "gsv/gateway/live/live_stream.h"

#include <algorithm>
#include <utility>

#include "gsv/gateway/foxglove/channels.h"
#include "gsv/gateway/live/live_operations.h"
#include "gsv/messages/time.h"
#include "gsv/presentation/packed_poses.h"
#include "gsv/presentation/state_messages.h"

namespace gsv::gateway {
namespace {

namespace topics = presentation::topics;

constexpr double kRefreshRate = 1;  // Hz: rate at which new sensors are searched for

foxglove::ServerInfo InfoOf(const simulation::Simulation& simulation) {
  const auto started = std::chrono::system_clock::now().time_since_epoch();
  return {"gsv: " + simulation.specification().name,
          {"time"},
          {{"simulation", simulation.specification().name}},
          std::to_string(std::chrono::duration_cast<std::chrono::microseconds>(started).count())};
}

}  // namespace

LiveStream::LiveStream(const std::shared_ptr<simulation::Simulation>& simulation,
                       WorkerPool& watchers, WorkerPool& commanders, RecordingSwitch* recordings,
                       std::function<void()> on_demand, access::ViewerRegistry* registry)
    : hub_(std::make_shared<Hub>(
          InfoOf(*simulation), std::move(on_demand),
          std::make_shared<LiveOperations>(simulation, commanders, recordings))),
      snapshot_topics_(5),
      status_(hub_),
      events_(hub_),
      health_(hub_),
      refresh_pacing_(kRefreshRate),
      commands_(hub_),
      contacts_(hub_, topics::kContacts, CollectContacts),
      radio_(hub_, topics::kRadio, CollectTransmissions),
      step_costs_(hub_),
      viewers_(hub_, registry) {
  const std::vector<foxglove::ChannelId> channels = hub_->Advertise(
      {ChannelFor(topics::kClock), ChannelFor(topics::kPoses), ChannelFor(topics::kTransforms),
       ChannelFor(topics::kPackedPoses), ChannelFor(topics::kCurrentContacts)});
  snapshot_topics_[0].encode = &LiveStream::EncodeClock;
  snapshot_topics_[1].encode = &LiveStream::EncodePoses;
  snapshot_topics_[2].encode = &LiveStream::EncodeTransforms;
  snapshot_topics_[3].encode = &LiveStream::EncodePackedPoses;
  snapshot_topics_[3].rate = kPackedPosesRate;
  snapshot_topics_[3].min_rate = kMinPackedPosesRate;
  snapshot_topics_[4].encode = &LiveStream::EncodeContacts;
  snapshot_topics_[4].rate = kContactsRate;
  snapshot_topics_[4].min_rate = kMinContactsRate;
  for (std::size_t i = 0; i < channels.size(); ++i) snapshot_topics_[i].channel = channels[i];
  sensors_ = std::make_shared<SensorTopics>(hub_, watchers);
}

void LiveStream::Round(const std::shared_ptr<simulation::Simulation>& simulation, WallTime now) {
  contacts_.Publish(*simulation);
  radio_.Publish(*simulation);
  step_costs_.Publish(*simulation, now);
  if (!hub_->has_clients()) return;
  const SnapshotPointer snapshot = simulation->snapshot();
  FollowLayout(*simulation, *snapshot, now);
  PublishTime(snapshot);
  for (SnapshotTopic& topic : snapshot_topics_) Publish(topic, snapshot, now);
  status_.Publish(*simulation, now);
  events_.Publish(*simulation);
  health_.Publish(*simulation, now);
  commands_.Publish(*snapshot);
  viewers_.Publish(now);
  sensors_->Publish(simulation, snapshot, now);
  hub_->PublishChanges();
}

void LiveStream::FollowLayout(simulation::Simulation& simulation, const world::Snapshot& snapshot,
                              WallTime now) {
  const bool is_new = snapshot.layout != layout_;
  if (is_new) {
    layout_ = snapshot.layout;
    pose_list_ = presentation::PoseListOf(*layout_);
  }
  // Sensors can be mounted without changing the layout, so they are searched for once per second.
  if (!is_new && !sensors_->has_requests() && !refresh_pacing_.IsDue(now)) return;
  sensors_->Refresh(simulation, snapshot);
  refresh_pacing_.Done(now);
}

void LiveStream::PublishTime(const SnapshotPointer& snapshot) {
  if (time_of_.lock() == snapshot) return;
  time_of_ = snapshot;
  hub_->PublishTime(base::NanosecondsOf(snapshot->state.time));
}

void LiveStream::Publish(SnapshotTopic& topic, const SnapshotPointer& snapshot, WallTime now) {
  if (!hub_->IsSubscribed(topic.channel)) return;
  const bool is_due = topic.published.lock() != snapshot && topic.pacing.IsDue(now);
  if (!is_due && !hub_->HasNewSubscribers(topic.channel)) return;
  if (topic.published.lock() != snapshot) {
    topic.latest = {base::NanosecondsOf(snapshot->state.time), (this->*topic.encode)(*snapshot)};
  }
  if (!is_due) return hub_->Welcome(topic.channel, {&topic.latest, 1});
  hub_->Publish(topic.channel, topic.latest);
  topic.published = snapshot;
  topic.pacing.SetRate(RateFor(topic));
  topic.pacing.Done(now);
}

double LiveStream::RateFor(const SnapshotTopic& topic) {
  const double size = static_cast<double>(std::max<std::size_t>(1, topic.latest.payload.size()));
  const double lowest = std::min(topic.min_rate, topic.rate);
  return std::clamp(kMaxSnapshotBytesPerSecond / size, lowest, topic.rate);
}

SharedBytes LiveStream::EncodeClock(const world::Snapshot& snapshot) const {
  return Encoded(messages::rosgraph_msgs::Clock{messages::ToMessage(snapshot.state.time)});
}

SharedBytes LiveStream::EncodePoses(const world::Snapshot& snapshot) const {
  return Encoded(presentation::PosesMessage(snapshot, presentation::PosesOf(snapshot, pose_list_)));
}

SharedBytes LiveStream::EncodePackedPoses(const world::Snapshot& snapshot) const {
  return Encoded(presentation::PackedPosesMessage(snapshot, pose_list_));
}

SharedBytes LiveStream::EncodeTransforms(const world::Snapshot& snapshot) const {
  return Encoded(presentation::TransformsMessage(snapshot, pose_list_));
}

SharedBytes LiveStream::EncodeContacts(const world::Snapshot& snapshot) const {
  return Encoded(presentation::ContactsMessage(snapshot));
}

}  // namespace gsv::gateway
