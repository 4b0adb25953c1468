#include "gsv/gateway/recorded_timeline.h"

#include <algorithm>
#include <cstdlib>

#include "gsv/messages/gsv_msgs.h"

namespace gsv::gateway {
namespace {

using recording::MessageBlock;

constexpr std::size_t kMostEvents = 1000;
constexpr std::size_t kMostEventBytes = 1 << 20;

// A block without an index may hold anything.
bool MayHold(const MessageBlock& block, const std::set<std::uint16_t>& channels) {
  return block.channels.empty() ||
         std::any_of(block.channels.begin(), block.channels.end(),
                     [&](std::uint16_t channel) { return channels.contains(channel); });
}

}  // namespace

RecordedTimeline::RecordedTimeline(const recording::McapReader& reader)
    : reader_(reader),
      pose_channels_(ChannelsOf("/gsv/poses")),
      event_channels_(ChannelsOf("/gsv/events")) {}

RecordedTimeline::ChannelIds RecordedTimeline::ChannelsOf(const std::string& topic) const {
  ChannelIds ids;
  for (const auto& [id, channel] : reader_.summary().channels) {
    if (channel.topic == topic && channel.message_encoding == "cdr") ids.insert(id);
  }
  return ids;
}

base::SimTime RecordedTimeline::PoseBeside(base::SimTime time, std::int64_t count) const {
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
  std::stable_sort(blocks.begin(), blocks.end(), [&](const MessageBlock* a, const MessageBlock* b) {
    return nearest(*a) < nearest(*b);
  });
  const auto wanted = static_cast<std::size_t>(std::abs(count));
  std::set<base::SimTime> distances;  // of poses, the nearest first; no more than are wanted
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

std::vector<RecordedEvent> RecordedTimeline::ReadEvents() const {
  std::vector<RecordedEvent> events;
  std::size_t bytes = 0;
  const auto is_full = [&] { return events.size() >= kMostEvents || bytes > kMostEventBytes; };
  for (const MessageBlock& block : reader_.summary().blocks) {
    if (is_full()) break;
    if (!MayHold(block, event_channels_)) continue;
    const base::Result<recording::BlockMessages> content = reader_.Messages(block);
    if (!content) continue;
    for (const recording::MessageRecord& message : content->messages) {
      if (is_full()) break;
      if (!event_channels_.contains(message.channel_id)) continue;
      auto event = messages::Decode<messages::gsv_msgs::LifecycleEvent>(
          std::as_bytes(std::span(message.data)));
      if (!event) continue;
      bytes += message.data.size();
      events.push_back({message.log_time, std::move(event->event), std::move(event->robot),
                        std::move(event->detail)});
    }
  }
  std::stable_sort(events.begin(), events.end(),
                   [](const RecordedEvent& a, const RecordedEvent& b) { return a.time < b.time; });
  return events;
}

}  // namespace gsv::gateway
