// The channels of one simulation, the clients that listen, and who of them listens to what. Where
// the messages come from (a simulation here, or another instance) is no concern of it.
//
// Threads  any; no call blocks. Clients are called under the hub's lock: they queue, and do not
//          call back.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "gsv/base/error.h"
#include "gsv/base/mutex.h"
#include "gsv/gateway/foxglove/client.h"
#include "gsv/gateway/foxglove/client_requests.h"

namespace gsv::gateway {

class Hub {
 public:
  // `on_demand` is called, without the lock, whenever somebody came, went, subscribed or
  // unsubscribed; it must return at once. Without `operations` clients can do nothing but listen.
  Hub(foxglove::ServerInfo info, std::function<void()> on_demand,
      std::shared_ptr<Operations> operations = nullptr);

  // The name of what its clients watch, as it tells them; empty: it tells none.
  const std::string& simulation() const { return simulation_; }

  // The clients' side.
  void Add(std::shared_ptr<Client> client,
           std::string_view subprotocol = foxglove::kSubprotocols.front());
  void Remove(Client* client);
  // One message from a client, text or binary. An error is what to close the connection with.
  base::Status Receive(Client* client, std::string_view text);
  base::Status ReceiveBytes(Client* client, std::string_view bytes);

  // The publishers' side. Advertise() gives each channel a number that is never used again.
  std::vector<foxglove::ChannelId> Advertise(std::vector<foxglove::Channel> channels);
  void Unadvertise(std::span<const foxglove::ChannelId> channels);

  bool has_clients() const;
  bool IsSubscribed(foxglove::ChannelId channel) const;
  // Somebody subscribed who has got nothing on this channel yet.
  bool HasNewSubscribers(foxglove::ChannelId channel) const;
  // In order. Takes as long as there are subscriptions, however many channels there are.
  std::vector<foxglove::ChannelId> SubscribedChannels() const;

  struct Message {
    std::uint64_t time_ns = 0;  // NanosecondsOf(simulated time)
    SharedBytes payload;
  };
  enum class Audience {
    kAll,
    kEstablished,  // all but newcomers
  };
  void Publish(foxglove::ChannelId channel, const Message& message,
               Audience audience = Audience::kAll);
  // Gives the newcomers what they missed; from then on they are established.
  void Welcome(foxglove::ChannelId channel, std::span<const Message> messages);
  void PublishTime(std::uint64_t time_ns);
  // Who comes later hears the newest of them as well.
  void SendStatus(foxglove::StatusLevel level, std::string_view message);
  // Who publishes on a channel, for those who look at the graph; at first it is "gsv".
  void SetPublishers(foxglove::ChannelId channel, std::set<std::string> publishers);
  // Tells what has changed since the last call: the graph, parameters, a playback's state.
  void PublishChanges(bool has_jumped = false);

  // No client is added any more; each that comes is closed with the same words.
  void Close(CloseCode code, const std::string& reason);

 private:
  struct Listener {
    foxglove::SubscriptionId subscription = 0;
    bool is_new = true;
  };
  struct Member {
    std::shared_ptr<Client> client;
    std::string name;  // in the graph
    bool watches_graph = false;
    std::map<foxglove::SubscriptionId, foxglove::ChannelId> subscriptions{};
  };
  struct Topic {
    foxglove::Channel channel;
    std::map<Client*, Listener> listeners;
    std::set<std::string> publishers{"gsv"};
  };

  void Take(Client* client, const foxglove::ClientMessage& message);

  void Apply(Member& member, const foxglove::Subscribe& message) GSV_REQUIRES(mutex_);
  void Apply(Member& member, const foxglove::Unsubscribe& message) GSV_REQUIRES(mutex_);
  void Apply(Member& member, const foxglove::WatchGraph& message) GSV_REQUIRES(mutex_);
  void Apply(Member& member, const foxglove::Unsupported& message) GSV_REQUIRES(mutex_);
  static void Complain(Member& member, std::string_view message);
  bool IsGraphWatched() const GSV_REQUIRES(mutex_);
  foxglove::ConnectionGraph Graph() const GSV_REQUIRES(mutex_);
  void PublishGraph();

  foxglove::ServerInfo info_;
  const std::string simulation_;
  const std::function<void()> on_demand_;
  mutable base::Mutex mutex_;
  foxglove::ChannelId next_channel_ GSV_GUARDED_BY(mutex_) = 1;
  std::map<foxglove::ChannelId, Topic> topics_ GSV_GUARDED_BY(mutex_);
  std::map<Client*, Member> members_ GSV_GUARDED_BY(mutex_);
  std::uint64_t next_member_ GSV_GUARDED_BY(mutex_) = 1;
  std::deque<SharedBytes> statuses_ GSV_GUARDED_BY(mutex_);
  bool has_graph_changed_ GSV_GUARDED_BY(mutex_) = false;
  foxglove::ConnectionGraph graph_ GSV_GUARDED_BY(mutex_);  // as it was told last
  ClientRequests requests_;
  bool closed_ GSV_GUARDED_BY(mutex_) = false;
  CloseCode close_code_ GSV_GUARDED_BY(mutex_){};
  std::string close_reason_ GSV_GUARDED_BY(mutex_);
};

}  // namespace gsv::gateway
