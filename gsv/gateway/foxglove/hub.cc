#include "gsv/gateway/foxglove/hub.h"

#include <algorithm>
#include <utility>

#include "gsv/presentation/topics.h"

namespace gsv::gateway {

using foxglove::ChannelId;
using foxglove::StatusLevel;

namespace {

constexpr std::size_t kStatusesKept = 20;

std::string SimulationOf(const foxglove::ServerInfo& info) {
  const auto found = info.metadata.find("simulation");
  return found == info.metadata.end() ? std::string() : found->second;
}

Delivery DeliveryOf(const std::string& topic) {
  const presentation::Topic* const row = presentation::FindTopic(topic);
  return row == nullptr || row->is_state ? Delivery::kNewest : Delivery::kEach;
}

}  // namespace

Hub::Hub(foxglove::ServerInfo info, std::function<void()> on_demand,
         std::shared_ptr<Operations> operations)
    : info_(std::move(info)),
      simulation_(SimulationOf(info_)),
      on_demand_(std::move(on_demand)),
      requests_(std::move(operations)) {
  info_.capabilities.push_back("connectionGraph");
  for (std::string& name : requests_.capabilities()) info_.capabilities.push_back(std::move(name));
}

void Hub::Offer(std::shared_ptr<Views> views) {
  const base::MutexLock lock(mutex_);
  if (views_ == nullptr) views_ = std::move(views);
}

std::shared_ptr<Views> Hub::views() const {
  const base::MutexLock lock(mutex_);
  return views_;
}

void Hub::Add(std::shared_ptr<Client> client, std::string_view subprotocol) {
  // The older subprotocol has no playbacks, so its clients do not get the playback's state.
  const bool knows_playback = subprotocol == foxglove::kSubprotocols.front();
  {
    const base::MutexLock lock(mutex_);
    foxglove::ServerInfo info = info_;
    if (!knows_playback) info.playback.reset();
    if (views_) info.capabilities.emplace_back(kViewsCapability);
    client->SendText(SharedBytes(foxglove::ServerInfoText(info)));
    if (closed_) {
      client->Close(close_code_, close_reason_);
      return;
    }
    std::vector<foxglove::Channel> channels;
    for (const auto& [id, topic] : topics_) channels.push_back(topic.channel);
    client->SendText(SharedBytes(foxglove::AdvertiseText(channels)));
    for (const SharedBytes& status : statuses_) client->SendText(status);
    members_[client.get()] = Member{client, "viewer " + std::to_string(next_member_++)};
  }
  requests_.Welcome(client, knows_playback);
  on_demand_();
}

void Hub::Remove(Client* client) {
  requests_.Forget(client);
  if (const auto drawn = views()) drawn->Forget(client);
  {
    const base::MutexLock lock(mutex_);
    members_.erase(client);
    for (auto& [id, topic] : topics_) topic.listeners.erase(client);
    has_graph_changed_ = true;
  }
  on_demand_();
}

base::Status Hub::Receive(Client* client, std::string_view text) {
  const base::Result<foxglove::ClientMessage> message = foxglove::ParseClientMessage(text);
  if (!message) return base::Fail(message.error());
  Handle(client, *message);
  return {};
}

base::Status Hub::ReceiveBytes(Client* client, std::string_view bytes) {
  const base::Result<foxglove::ClientMessage> message = foxglove::ParseClientBytes(bytes);
  if (!message) return base::Fail(message.error());
  Handle(client, *message);
  return {};
}

void Hub::Handle(Client* client, const foxglove::ClientMessage& message) {
  std::shared_ptr<Client> sender;
  {
    const base::MutexLock lock(mutex_);
    const auto member = members_.find(client);
    if (member == members_.end()) return;
    sender = member->second.client;
    std::visit(
        [&](const auto& content) GSV_REQUIRES(mutex_) {
          if constexpr (requires { Apply(member->second, content); })
            Apply(member->second, content);
        },
        message);
  }
  std::visit(
      [&](const auto& content) {
        if constexpr (requires { requests_.Handle(sender, content); })
          requests_.Handle(sender, content);
        if constexpr (requires(Views & drawn) { drawn.Handle(sender, content); })
          HandleView(sender, content);
      },
      message);
  on_demand_();
}

template <typename Request>
void Hub::HandleView(const std::shared_ptr<Client>& client, const Request& request) {
  if (const auto drawn = views()) return drawn->Handle(client, request);
  client->SendText(
      SharedBytes(foxglove::ViewFailureText(request.id, "this server draws no views")));
}

void Hub::Apply(Member& member, const foxglove::Subscribe& message) {
  for (const foxglove::Subscription& wish : message.subscriptions) {
    const auto topic = topics_.find(wish.channel);
    if (topic == topics_.end()) {
      SendWarning(member,
                  "there is no channel " + std::to_string(wish.channel) + " to subscribe to");
    } else if (member.subscriptions.contains(wish.id)) {
      SendWarning(member, "the subscription " + std::to_string(wish.id) +
                              " is in use; unsubscribe it first, or take another number");
    } else if (!topic->second.listeners.try_emplace(member.client.get(), Listener{wish.id})
                    .second) {
      SendWarning(member,
                  "the channel " + topic->second.channel.topic + " is subscribed to already");
    } else {
      member.subscriptions.emplace(wish.id, wish.channel);
      has_graph_changed_ = true;
    }
  }
}

void Hub::Apply(Member& member, const foxglove::Unsubscribe& message) {
  for (const foxglove::SubscriptionId id : message.subscriptions) {
    const auto subscription = member.subscriptions.find(id);
    if (subscription == member.subscriptions.end()) {
      SendWarning(member, "there is no subscription " + std::to_string(id) + " to end");
      continue;
    }
    const auto topic = topics_.find(subscription->second);
    if (topic != topics_.end()) topic->second.listeners.erase(member.client.get());
    member.subscriptions.erase(subscription);
    has_graph_changed_ = true;
  }
}

void Hub::Apply(Member& member, const foxglove::WatchGraph& message) {
  if (member.watches_graph == !message.is_end) return;
  if (!message.is_end) {
    foxglove::ConnectionGraph now = Graph();
    const std::string text = foxglove::GraphUpdateText({}, now);
    if (!text.empty()) member.client->SendText(SharedBytes(text));
    if (!IsGraphWatched()) graph_ = std::move(now);
  }
  member.watches_graph = !message.is_end;
}

void Hub::Apply(Member& member, const foxglove::Unsupported& message) {
  SendWarning(member, "this server does not offer the operation '" + message.op + "'");
}

void Hub::SendWarning(Member& member, std::string_view message) {
  member.client->SendStatus(StatusLevel::kError, message);
}

std::vector<ChannelId> Hub::Advertise(std::vector<foxglove::Channel> channels) {
  if (channels.empty()) return {};
  const base::MutexLock lock(mutex_);
  std::vector<ChannelId> ids;
  for (foxglove::Channel& channel : channels) {
    channel.id = next_channel_++;
    ids.push_back(channel.id);
  }
  const SharedBytes text(foxglove::AdvertiseText(channels));
  for (foxglove::Channel& channel : channels) {
    Topic& topic = topics_[channel.id];
    topic.delivery = DeliveryOf(channel.topic);
    topic.channel = std::move(channel);
  }
  has_graph_changed_ = true;
  for (auto& [key, member] : members_) member.client->SendText(text);
  return ids;
}

void Hub::Unadvertise(std::span<const ChannelId> channels) {
  if (channels.empty()) return;
  const base::MutexLock lock(mutex_);
  for (const ChannelId id : channels) topics_.erase(id);
  has_graph_changed_ = true;
  const SharedBytes text(foxglove::UnadvertiseText(channels));
  for (auto& [key, member] : members_) {
    std::erase_if(member.subscriptions, [&](const auto& subscription) GSV_REQUIRES(mutex_) {
      return !topics_.contains(subscription.second);
    });
    member.client->SendText(text);
  }
}

bool Hub::has_clients() const {
  const base::MutexLock lock(mutex_);
  return !members_.empty();
}

bool Hub::IsSubscribed(ChannelId channel) const {
  const base::MutexLock lock(mutex_);
  const auto topic = topics_.find(channel);
  return topic != topics_.end() && !topic->second.listeners.empty();
}

bool Hub::HasNewSubscribers(ChannelId channel) const {
  const base::MutexLock lock(mutex_);
  const auto topic = topics_.find(channel);
  if (topic == topics_.end()) return false;
  for (const auto& [client, listener] : topic->second.listeners) {
    if (listener.is_new) return true;
  }
  return false;
}

std::vector<ChannelId> Hub::SubscribedChannels() const {
  const base::MutexLock lock(mutex_);
  std::set<ChannelId> subscribed;
  for (const auto& [key, member] : members_) {
    for (const auto& [id, channel] : member.subscriptions) subscribed.insert(channel);
  }
  return {subscribed.begin(), subscribed.end()};
}

void Hub::Publish(ChannelId channel, const Message& message, Audience audience) {
  const base::MutexLock lock(mutex_);
  const auto topic = topics_.find(channel);
  if (topic == topics_.end()) return;
  for (auto& [client, listener] : topic->second.listeners) {
    if (audience == Audience::kEstablished && listener.is_new) continue;
    listener.is_new = false;
    client->SendData(foxglove::MessageDataHeader(listener.subscription, message.time_ns),
                     message.payload, topic->second.delivery);
  }
}

void Hub::Welcome(ChannelId channel, std::span<const Message> messages) {
  const base::MutexLock lock(mutex_);
  const auto topic = topics_.find(channel);
  if (topic == topics_.end()) return;
  for (auto& [client, listener] : topic->second.listeners) {
    if (!std::exchange(listener.is_new, false)) continue;
    for (const Message& message : messages) {
      client->SendData(foxglove::MessageDataHeader(listener.subscription, message.time_ns),
                       message.payload, topic->second.delivery);
    }
  }
}

void Hub::PublishTime(std::uint64_t time_ns) {
  const foxglove::BinaryHeader header = foxglove::TimeHeader(time_ns);
  const base::MutexLock lock(mutex_);
  for (auto& [key, member] : members_) {
    member.client->SendData(header, SharedBytes(), Delivery::kNewest);
  }
}

void Hub::SendStatus(StatusLevel level, std::string_view message) {
  const SharedBytes text(foxglove::StatusText(level, message));
  const base::MutexLock lock(mutex_);
  statuses_.push_back(text);
  if (statuses_.size() > kStatusesKept) statuses_.pop_front();
  for (auto& [key, member] : members_) member.client->SendText(text);
}

void Hub::SetPublishers(ChannelId channel, std::set<std::string> publishers) {
  const base::MutexLock lock(mutex_);
  const auto topic = topics_.find(channel);
  if (topic == topics_.end() || topic->second.publishers == publishers) return;
  topic->second.publishers = std::move(publishers);
  has_graph_changed_ = true;
}

void Hub::PublishChanges(bool has_jumped) {
  requests_.PublishChanges(has_jumped);
  PublishGraph();
}

void Hub::PublishGraph() {
  const base::MutexLock lock(mutex_);
  if (!has_graph_changed_ || !IsGraphWatched()) return;
  has_graph_changed_ = false;
  foxglove::ConnectionGraph now = Graph();
  const SharedBytes text(foxglove::GraphUpdateText(graph_, now));
  graph_ = std::move(now);
  if (text.size() == 0) return;
  for (auto& [key, member] : members_) {
    if (member.watches_graph) member.client->SendText(text);
  }
}

bool Hub::IsGraphWatched() const {
  return std::any_of(members_.begin(), members_.end(),
                     [](const auto& entry) { return entry.second.watches_graph; });
}

foxglove::ConnectionGraph Hub::Graph() const {
  foxglove::ConnectionGraph graph;
  for (const auto& [id, topic] : topics_) {
    const std::string& name = topic.channel.topic;
    graph.publishers[name].insert(topic.publishers.begin(), topic.publishers.end());
    for (const auto& [client, listener] : topic.listeners) {
      graph.subscribers[name].insert(members_.at(client).name);
    }
  }
  for (const std::string& service : requests_.service_names()) graph.providers[service] = {"gsv"};
  return graph;
}

void Hub::Close(CloseCode code, const std::string& reason) {
  const base::MutexLock lock(mutex_);
  closed_ = true;
  close_code_ = code;
  close_reason_ = reason;
  for (auto& [key, member] : members_) member.client->Close(code, reason);
}

}  // namespace gsv::gateway
