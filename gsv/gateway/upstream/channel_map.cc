#include "gsv/gateway/upstream/channel_map.h"

#include <algorithm>
#include <set>
#include <utility>

#include "gsv/presentation/topics.h"

namespace gsv::gateway::upstream {

using foxglove::ChannelId;

namespace {

// Limits the data that an untrusted server can make the relay store.
constexpr std::size_t kMaxChannels = 10'000;

}  // namespace

void ChannelMap::Handle(const Advertise& message) {
  std::vector<foxglove::Channel> fresh;
  for (const foxglove::Channel& channel : message.channels) {
    const bool is_known = ours_by_theirs_.contains(channel.id);
    if (!is_known && sources_.size() + fresh.size() < kMaxChannels) fresh.push_back(channel);
  }
  const std::vector<ChannelId> ours = hub_->Advertise(fresh);
  for (std::size_t i = 0; i < ours.size(); ++i) {
    ours_by_theirs_.emplace(fresh[i].id, ours[i]);
    Source& source = sources_[ours[i]];
    source.theirs = fresh[i].id;
    const presentation::Topic* const row = presentation::FindTopic(fresh[i].topic);
    if (row != nullptr) source.memory = row->history;
  }
}

void ChannelMap::Handle(const Unadvertise& message) {
  std::vector<ChannelId> gone;
  for (const ChannelId theirs : message.channels) {
    const auto known = ours_by_theirs_.find(theirs);
    if (known == ours_by_theirs_.end()) continue;
    gone.push_back(known->second);
    sources_.erase(known->second);
    ours_by_theirs_.erase(known);
  }
  hub_->Unadvertise(gone);
}

void ChannelMap::Handle(const MessageData& message) {
  const auto found = sources_.find(message.subscription);
  if (found == sources_.end() || !found->second.is_subscribed) return;
  Source& source = found->second;
  Hub::Message data{message.time_ns, SharedBytes(std::string(message.payload))};
  source.latest.push_back(data);
  if (source.latest.size() > source.memory) source.latest.pop_front();
  hub_->Publish(found->first, data, Hub::Audience::kEstablished);
  Welcome(found->first, source);
}

std::vector<std::string> ChannelMap::FollowDemand() {
  const std::vector<ChannelId> list = hub_->SubscribedChannels();
  const std::set<ChannelId> wanted(list.begin(), list.end());
  std::vector<foxglove::Subscription> begin;
  std::vector<foxglove::SubscriptionId> end;
  for (auto& [ours, source] : sources_) {
    const bool is_wanted = wanted.contains(ours);
    if (is_wanted == source.is_subscribed) continue;
    if (is_wanted) {
      begin.push_back({ours, source.theirs});
    } else {
      end.push_back(ours);
      source.latest.clear();
    }
    source.is_subscribed = is_wanted;
  }
  std::vector<std::string> texts;
  if (!begin.empty()) texts.push_back(SubscribeText(begin));
  if (!end.empty()) texts.push_back(UnsubscribeText(end));
  return texts;
}

void ChannelMap::ServeNewSubscribers() {
  for (const auto& [ours, source] : sources_) {
    if (!source.latest.empty()) Welcome(ours, source);
  }
}

void ChannelMap::Welcome(ChannelId ours, const Source& source) {
  if (!hub_->HasNewSubscribers(ours)) return;
  hub_->Welcome(ours, std::vector<Hub::Message>(source.latest.begin(), source.latest.end()));
}

void ChannelMap::Clear() {
  std::vector<ChannelId> gone;
  for (const auto& [ours, source] : sources_) gone.push_back(ours);
  sources_.clear();
  ours_by_theirs_.clear();
  hub_->Unadvertise(gone);
}

}  // namespace gsv::gateway::upstream
