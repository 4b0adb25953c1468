#include "gsv/gateway/hub.h"

#include <utility>

namespace gsv::gateway {

using foxglove::ChannelId;
using foxglove::StatusLevel;

Hub::Hub(foxglove::ServerInfo info, std::function<void()> on_demand)
    : info_(std::move(info)), on_demand_(std::move(on_demand)) {}

void Hub::Add(std::shared_ptr<Client> client) {
  {
    const std::lock_guard lock(mutex_);
    client->SendText(SharedBytes(foxglove::ServerInfoText(info_)));
    if (closed_) {
      client->Close(close_code_, close_reason_);
      return;
    }
    std::vector<foxglove::Channel> channels;
    for (const auto& [id, topic] : topics_) channels.push_back(topic.channel);
    client->SendText(SharedBytes(foxglove::AdvertiseText(channels)));
    Client* key = client.get();
    members_[key].client = std::move(client);
  }
  on_demand_();
}

void Hub::Remove(Client* client) {
  {
    const std::lock_guard lock(mutex_);
    members_.erase(client);
    for (auto& [id, topic] : topics_) topic.listeners.erase(client);
  }
  on_demand_();
}

base::Status Hub::Receive(Client* client, std::string_view text) {
  const base::Result<foxglove::ClientMessage> message = foxglove::ParseClientMessage(text);
  if (!message) return base::Fail(message.error());
  {
    const std::lock_guard lock(mutex_);
    const auto member = members_.find(client);
    if (member == members_.end()) return {};
    std::visit([&](const auto& content) { Apply(member->second, content); }, *message);
  }
  on_demand_();
  return {};
}

void Hub::Apply(Member& member, const foxglove::Subscribe& message) {
  for (const foxglove::Subscription& wish : message.subscriptions) {
    const auto topic = topics_.find(wish.channel);
    if (topic == topics_.end()) {
      Complain(member, "there is no channel " + std::to_string(wish.channel) + " to subscribe to");
    } else if (member.subscriptions.contains(wish.id)) {
      Complain(member, "the subscription " + std::to_string(wish.id) +
                           " is in use; unsubscribe it first, or take another number");
    } else if (!topic->second.listeners.try_emplace(member.client.get(), Listener{wish.id})
                    .second) {
      Complain(member, "the channel " + topic->second.channel.topic + " is subscribed to already");
    } else {
      member.subscriptions.emplace(wish.id, wish.channel);
    }
  }
}

void Hub::Apply(Member& member, const foxglove::Unsubscribe& message) {
  for (const foxglove::SubscriptionId id : message.subscriptions) {
    const auto subscription = member.subscriptions.find(id);
    if (subscription == member.subscriptions.end()) {
      Complain(member, "there is no subscription " + std::to_string(id) + " to end");
      continue;
    }
    const auto topic = topics_.find(subscription->second);
    if (topic != topics_.end()) topic->second.listeners.erase(member.client.get());
    member.subscriptions.erase(subscription);
  }
}

void Hub::Apply(Member& member, const foxglove::Unsupported& message) {
  Complain(member, "this server does not offer the operation '" + message.op + "'");
}

void Hub::Complain(Member& member, std::string_view message) {
  member.client->SendText(SharedBytes(foxglove::StatusText(StatusLevel::kError, message)));
}

std::vector<ChannelId> Hub::Advertise(std::vector<foxglove::Channel> channels) {
  if (channels.empty()) return {};
  const std::lock_guard lock(mutex_);
  std::vector<ChannelId> ids;
  for (foxglove::Channel& channel : channels) {
    channel.id = next_channel_++;
    ids.push_back(channel.id);
  }
  const SharedBytes text(foxglove::AdvertiseText(channels));
  for (foxglove::Channel& channel : channels) {
    topics_[channel.id].channel = std::move(channel);
  }
  for (auto& [key, member] : members_) member.client->SendText(text);
  return ids;
}

void Hub::Unadvertise(std::span<const ChannelId> channels) {
  if (channels.empty()) return;
  const std::lock_guard lock(mutex_);
  for (const ChannelId id : channels) topics_.erase(id);
  const SharedBytes text(foxglove::UnadvertiseText(channels));
  for (auto& [key, member] : members_) {
    std::erase_if(member.subscriptions,
                  [&](const auto& subscription) { return !topics_.contains(subscription.second); });
    member.client->SendText(text);
  }
}

bool Hub::has_clients() const {
  const std::lock_guard lock(mutex_);
  return !members_.empty();
}

bool Hub::IsSubscribed(ChannelId channel) const {
  const std::lock_guard lock(mutex_);
  const auto topic = topics_.find(channel);
  return topic != topics_.end() && !topic->second.listeners.empty();
}

bool Hub::HasNewcomers(ChannelId channel) const {
  const std::lock_guard lock(mutex_);
  const auto topic = topics_.find(channel);
  if (topic == topics_.end()) return false;
  for (const auto& [client, listener] : topic->second.listeners) {
    if (listener.is_new) return true;
  }
  return false;
}

std::vector<ChannelId> Hub::SubscribedChannels() const {
  const std::lock_guard lock(mutex_);
  std::vector<ChannelId> subscribed;
  for (const auto& [id, topic] : topics_) {
    if (!topic.listeners.empty()) subscribed.push_back(id);
  }
  return subscribed;
}

void Hub::Publish(ChannelId channel, const Message& message, Audience audience) {
  const std::lock_guard lock(mutex_);
  const auto topic = topics_.find(channel);
  if (topic == topics_.end()) return;
  for (auto& [client, listener] : topic->second.listeners) {
    if (audience == Audience::kEstablished && listener.is_new) continue;
    listener.is_new = false;
    client->SendData(foxglove::MessageDataHeader(listener.subscription, message.time_ns),
                     message.payload);
  }
}

void Hub::Welcome(ChannelId channel, std::span<const Message> messages) {
  const std::lock_guard lock(mutex_);
  const auto topic = topics_.find(channel);
  if (topic == topics_.end()) return;
  for (auto& [client, listener] : topic->second.listeners) {
    if (!std::exchange(listener.is_new, false)) continue;
    for (const Message& message : messages) {
      client->SendData(foxglove::MessageDataHeader(listener.subscription, message.time_ns),
                       message.payload);
    }
  }
}

void Hub::PublishTime(std::uint64_t time_ns) {
  const foxglove::BinaryHeader header = foxglove::TimeHeader(time_ns);
  const std::lock_guard lock(mutex_);
  for (auto& [key, member] : members_) member.client->SendData(header, SharedBytes());
}

void Hub::SendStatus(StatusLevel level, std::string_view message) {
  const SharedBytes text(foxglove::StatusText(level, message));
  const std::lock_guard lock(mutex_);
  for (auto& [key, member] : members_) member.client->SendText(text);
}

void Hub::Close(CloseCode code, const std::string& reason) {
  const std::lock_guard lock(mutex_);
  closed_ = true;
  close_code_ = code;
  close_reason_ = reason;
  for (auto& [key, member] : members_) member.client->Close(code, reason);
}

}  // namespace gsv::gateway
