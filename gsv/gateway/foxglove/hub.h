// A Hub distributes the messages of one simulation to its clients. It stores the channels, the
// clients and their subscriptions. The messages come from elsewhere: from a simulation of this
// program, from a recording, or from another instance.
//
// Threads  any; no call blocks. Clients are called with the hub's lock held, and must not call
//          back.
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
#include "gsv/gateway/foxglove/views.h"

namespace gsv::gateway {

// Distributes the messages of one simulation to its clients.
class Hub {
 public:
  // `on_demand` is called without the lock after each change of clients or subscriptions, and must
  // return at once. `operations` null: clients can only subscribe.
  Hub(foxglove::ServerInfo info, std::function<void()> on_demand,
      std::shared_ptr<Operations> operations = nullptr);

  // Offers images that the server draws (Views) to clients that connect later. Only the first call
  // has an effect.
  void Offer(std::shared_ptr<Views> views);

  // The name of the simulation in the server info; empty: none.
  const std::string& simulation() const { return simulation_; }

  // Adds a client, which gets the server info and the channels. After Close(), disconnects the
  // client instead.
  void Add(std::shared_ptr<Client> client,
           std::string_view subprotocol = foxglove::kSubprotocols.front());
  // Removes a client.
  void Remove(Client* client);
  // Handles a message from a client, text or binary. After an error the connection must be closed.
  base::Status Receive(Client* client, std::string_view text);
  base::Status ReceiveBytes(Client* client, std::string_view bytes);

  // Publishers call these functions. Advertise() gives each channel a unique number.
  std::vector<foxglove::ChannelId> Advertise(std::vector<foxglove::Channel> channels);
  void Unadvertise(std::span<const foxglove::ChannelId> channels);

  bool has_clients() const;
  // Whether the channel has subscribers.
  bool IsSubscribed(foxglove::ChannelId channel) const;
  // Whether the channel has subscribers that have received no message on it yet.
  bool HasNewSubscribers(foxglove::ChannelId channel) const;
  // Returns the channels that have subscribers, in ascending order. The cost grows with the number
  // of subscriptions, not of channels.
  std::vector<foxglove::ChannelId> SubscribedChannels() const;

  // A message for the subscribers of a channel.
  struct Message {
    std::uint64_t time_ns = 0;  // NanosecondsOf(simulated time)
    SharedBytes payload;
  };
  // The subscribers that get a message.
  enum class Audience {
    kAll,
    kEstablished,  // all subscribers except new subscribers
  };
  // Sends a message to the subscribers of a channel.
  void Publish(foxglove::ChannelId channel, const Message& message,
               Audience audience = Audience::kAll);
  // Sends earlier messages to new subscribers, which then count as established.
  void Welcome(foxglove::ChannelId channel, std::span<const Message> messages);
  // Sends the simulated time to all clients.
  void PublishTime(std::uint64_t time_ns);
  // Sends a status message. Clients that connect later get the newest status messages as well.
  void SendStatus(foxglove::StatusLevel level, std::string_view message);
  // Sets the publishers of a channel in the connection graph (default: "gsv").
  void SetPublishers(foxglove::ChannelId channel, std::set<std::string> publishers);
  // Publishes what has changed since the last call: the graph, the parameters, the playback state.
  // `has_jumped`: a replay has jumped to another time (a seek). Then all clients get the playback
  // state.
  void PublishChanges(bool has_jumped = false);

  // Disconnects all clients, and each client that connects later, with this reason.
  void Close(CloseCode code, const std::string& reason);

 private:
  // A subscription to a topic; it is new until its first message.
  struct Listener {
    foxglove::SubscriptionId subscription = 0;
    bool is_new = true;
  };
  // A client of the hub.
  struct Member {
    std::shared_ptr<Client> client;
    std::string name;            // name of the client in the graph
    bool watches_graph = false;  // whether it gets changes of the connection graph
    // The channel of each subscription.
    std::map<foxglove::SubscriptionId, foxglove::ChannelId> subscriptions{};
  };
  // A channel with its subscribers and publishers.
  struct Topic {
    foxglove::Channel channel;
    std::map<Client*, Listener> listeners;
    std::set<std::string> publishers{"gsv"};
    Delivery delivery = Delivery::kNewest;  // how messages reach a slow client
  };

  // Carries out a message from a client.
  void Handle(Client* client, const foxglove::ClientMessage& message);

  template <typename Request>
  void HandleView(const std::shared_ptr<Client>& client, const Request& request);
  void Apply(Member& member, const foxglove::Subscribe& message) GSV_REQUIRES(mutex_);
  void Apply(Member& member, const foxglove::Unsubscribe& message) GSV_REQUIRES(mutex_);
  void Apply(Member& member, const foxglove::WatchGraph& message) GSV_REQUIRES(mutex_);
  void Apply(Member& member, const foxglove::Unsupported& message) GSV_REQUIRES(mutex_);
  // Sends the client an error as a status message.
  static void SendWarning(Member& member, std::string_view message);
  // Whether a client watches the connection graph.
  bool IsGraphWatched() const GSV_REQUIRES(mutex_);
  // Returns the connection graph.
  foxglove::ConnectionGraph Graph() const GSV_REQUIRES(mutex_);
  // Sends the changes of the connection graph to the clients that watch it.
  void PublishGraph();
  std::shared_ptr<Views> views() const;

  foxglove::ServerInfo info_;
  const std::string simulation_;
  const std::function<void()> on_demand_;  // see the constructor
  mutable base::Mutex mutex_;
  foxglove::ChannelId next_channel_ GSV_GUARDED_BY(mutex_) = 1;
  std::map<foxglove::ChannelId, Topic> topics_ GSV_GUARDED_BY(mutex_);
  std::map<Client*, Member> members_ GSV_GUARDED_BY(mutex_);
  std::uint64_t next_member_ GSV_GUARDED_BY(mutex_) = 1;     // number in the next client's name
  std::deque<SharedBytes> statuses_ GSV_GUARDED_BY(mutex_);  // the newest status messages
  bool has_graph_changed_ GSV_GUARDED_BY(mutex_) = false;
  foxglove::ConnectionGraph graph_ GSV_GUARDED_BY(mutex_);  // the graph that was last sent
  ClientRequests requests_;  // answers requests that do not concern channels
  std::shared_ptr<Views> views_ GSV_GUARDED_BY(mutex_);  // null: the server draws no views
  bool closed_ GSV_GUARDED_BY(mutex_) = false;           // whether Close() was called
  CloseCode close_code_ GSV_GUARDED_BY(mutex_){};
  std::string close_reason_ GSV_GUARDED_BY(mutex_);
};

}  // namespace gsv::gateway
