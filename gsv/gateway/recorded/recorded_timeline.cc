#include "gsv/gateway/recorded/recorded_timeline.h"

#include <algorithm>
#include <cstdlib>
#include <optional>

#include "gsv/base/sorting.h"
#include "gsv/messages/gsv_msgs.h"
#include "gsv/messages/rcl_interfaces.h"
#include "gsv/presentation/topics.h"

namespace gsv::gateway {
namespace {

using recording::MessageBlock;

constexpr std::size_t kMaxEvents = 1000;
constexpr std::size_t kMaxCollisions = 500;
constexpr std::size_t kMaxLines = 5000;
constexpr std::size_t kMaxBytes = 1 << 20;

// Whether the block may contain messages of these channels. A block without an index may contain
// messages of any channel.
bool MayHold(const MessageBlock& block, const std::set<std::uint16_t>& channels) {
  return block.channels.empty() ||
         std::any_of(block.channels.begin(), block.channels.end(),
                     [&](std::uint16_t channel) { return channels.contains(channel); });
}

}  // namespace

RecordedEvent CollisionEvent(base::SimTime time, const std::string& first,
                             const std::string& second) {
  return {time, "collision", first, first + " touches " + second};
}

RecordedTimeline::RecordedTimeline(const recording::McapReader& reader, const RecordedScene& scene)
    : reader_(reader),
      scene_(scene),
      pose_channels_(ChannelsOf(presentation::topics::kPoses.name)),
      event_channels_(ChannelsOf(presentation::topics::kEvents.name)),
      note_channels_(ChannelsOf(presentation::topics::kNotes.name)),
      contact_channels_(ChannelsOf(presentation::topics::kContacts.name)),
      log_channels_(ChannelsOf(presentation::topics::kLog.name)) {}

RecordedTimeline::ChannelIds RecordedTimeline::ChannelsOf(const std::string& topic) const {
  ChannelIds ids;
  for (const auto& [id, channel] : reader_.summary().channels) {
    if (channel.topic == topic && channel.message_encoding == "cdr") ids.insert(id);
  }
  return ids;
}

base::SimTime RecordedTimeline::TimeOfPoseFrom(base::SimTime time, std::int64_t count) const {
  const bool is_ahead = count > 0;
  const auto distance = [&](base::SimTime other) { return is_ahead ? other - time : time - other; };
  const auto nearest = [&](const MessageBlock& block) {
    return distance(is_ahead ? block.start : block.end);
  };
  std::vector<const MessageBlock*> blocks;
  for (const MessageBlock& block : reader_.summary().blocks) {
    const bool reaches_there = distance(is_ahead ? block.end : block.start) > base::SimTime(0);
    if (reaches_there && MayHold(block, pose_channels_)) blocks.push_back(&block);
  }
  base::Sort(blocks, [&](const MessageBlock* a, const MessageBlock* b) {
    return nearest(*a) < nearest(*b);
  });
  const auto wanted = static_cast<std::size_t>(std::abs(count));
  // The time differences to the nearest poses that were read until now; at most `wanted`.
  std::set<base::SimTime> distances;
  for (const MessageBlock* block : blocks) {
    if (distances.size() == wanted && nearest(*block) > *distances.rbegin()) break;
    const base::Result<recording::BlockMessages> content = reader_.Messages(*block);
    if (!content) continue;
    for (const recording::MessageRecord& message : content->messages) {
      const base::SimTime away = distance(message.log_time);
      if (away <= base::SimTime(0) || !pose_channels_.contains(message.channel_id)) continue;
      distances.insert(away);
      if (distances.size() > wanted) distances.erase(std::prev(distances.end()));
    }
  }
  if (distances.size() < wanted) return is_ahead ? reader_.summary().end : reader_.summary().start;
  return is_ahead ? time + *distances.rbegin() : time - *distances.rbegin();
}

const std::vector<RecordedEvent>& RecordedTimeline::Events() const {
  std::call_once(events_once_, [this] { events_ = ReadEvents(); });
  return events_;
}

const std::vector<RecordedLine>& RecordedTimeline::Log() const {
  std::call_once(log_once_, [this] { log_ = ReadLog(); });
  return log_;
}

template <typename Message, typename Entry, typename Use>
std::vector<Entry> RecordedTimeline::ReadAll(const ChannelIds& channels, std::size_t max_entries,
                                             Use use) const {
  std::vector<Entry> entries;
  std::size_t bytes = 0;
  const auto is_full = [&] { return entries.size() >= max_entries || bytes > kMaxBytes; };
  for (const MessageBlock& block : reader_.summary().blocks) {
    if (is_full()) break;
    if (!MayHold(block, channels)) continue;
    const base::Result<recording::BlockMessages> content = reader_.Messages(block);
    if (!content) continue;
    for (const recording::MessageRecord& message : content->messages) {
      if (is_full()) break;
      if (!channels.contains(message.channel_id)) continue;
      auto decoded = messages::Decode<Message>(std::as_bytes(std::span(message.data)));
      if (!decoded) continue;
      std::optional<Entry> entry = use(message.log_time, std::move(*decoded));
      if (!entry) continue;
      bytes += message.data.size();
      entries.push_back(*std::move(entry));
    }
  }
  base::Sort(entries, [](const Entry& a, const Entry& b) { return a.time < b.time; });
  return entries;
}

std::vector<RecordedEvent> RecordedTimeline::ReadEvents() const {
  using messages::gsv_msgs::Contact;
  using messages::gsv_msgs::LifecycleEvent;
  const auto of_event = [](base::SimTime time, LifecycleEvent event) {
    return std::optional(RecordedEvent{time, std::move(event.event), std::move(event.robot),
                                       std::move(event.detail)});
  };
  const auto of_contact = [this](base::SimTime time,
                                 const Contact& contact) -> std::optional<RecordedEvent> {
    if (scene_.IsRobot(contact.first)) return CollisionEvent(time, contact.first, contact.second);
    if (scene_.IsRobot(contact.second)) return CollisionEvent(time, contact.second, contact.first);
    return std::nullopt;
  };
  auto events = ReadAll<LifecycleEvent, RecordedEvent>(event_channels_, kMaxEvents, of_event);
  const auto notes = ReadAll<LifecycleEvent, RecordedEvent>(note_channels_, kMaxEvents, of_event);
  const auto collisions =
      ReadAll<Contact, RecordedEvent>(contact_channels_, kMaxCollisions, of_contact);
  events.insert(events.end(), notes.begin(), notes.end());
  events.insert(events.end(), collisions.begin(), collisions.end());
  base::Sort(events,
             [](const RecordedEvent& a, const RecordedEvent& b) { return a.time < b.time; });
  return events;
}

std::vector<RecordedLine> RecordedTimeline::ReadLog() const {
  using messages::rcl_interfaces::Log;
  return ReadAll<Log, RecordedLine>(log_channels_, kMaxLines, [](base::SimTime time, Log line) {
    return std::optional(RecordedLine{time, line.level, std::move(line.name), std::move(line.msg)});
  });
}

}  // namespace gsv::gateway
