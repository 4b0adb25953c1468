// The channels of one simulation, the clients that listen, and who of them listens to what. Where
// the messages come from (a simulation here, or another instance) is no concern of it.
//
// Threads  any; no call blocks. Clients are called under the hub's lock: they queue, and do not
// call
//          back.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "gsv/base/error.h"
#include "gsv/gateway/foxglove.h"
#include "gsv/gateway/shared_bytes.h"

namespace gsv::gateway {

// Why a connection is closed, as in RFC 6455, section 7.4.1.
enum class CloseCode : std::uint16_t {
  kGoingAway = 1001,
  kProtocolError = 1002,
  kPolicyViolation = 1008,
  kTooBig = 1009,
  kTryAgainLater = 1013,
};

// One connected viewer.
class Client {
 public:
  virtual ~Client() = default;
  virtual void SendText(SharedBytes text) = 0;
  virtual void SendData(const foxglove::BinaryHeader& header, SharedBytes payload) = 0;
  virtual void Close(CloseCode code, std::string reason) = 0;
};

class Hub {
 public:
  // `on_demand` is called, without the lock, whenever somebody came, went, subscribed or
  // unsubscribed; it must return at once.
  Hub(foxglove::ServerInfo info, std::function<void()> on_demand);

  // The clients' side.
  void Add(std::shared_ptr<Client> client);
  void Remove(Client* client);
  // One text from a client. An error is what to close the connection with.
  base::Status Receive(Client* client, std::string_view text);

  // The publishers' side. Advertise() gives each channel a number that is never used again.
  std::vector<foxglove::ChannelId> Advertise(std::vector<foxglove::Channel> channels);
  void Unadvertise(std::span<const foxglove::ChannelId> channels);

  bool has_clients() const;
  bool IsSubscribed(foxglove::ChannelId channel) const;
  // Somebody subscribed who has got nothing on this channel yet.
  bool HasNewcomers(foxglove::ChannelId channel) const;
  std::vector<foxglove::ChannelId> SubscribedChannels() const;

  struct Message {
    std::uint64_t time_ns = 0;
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
  void SendStatus(foxglove::StatusLevel level, std::string_view message);

  // No client is added any more; each that comes is closed with the same words.
  void Close(CloseCode code, const std::string& reason);

 private:
  struct Listener {
    foxglove::SubscriptionId subscription = 0;
    bool is_new = true;
  };
  struct Member {
    std::shared_ptr<Client> client;
    std::map<foxglove::SubscriptionId, foxglove::ChannelId> subscriptions;
  };
  struct Topic {
    foxglove::Channel channel;
    std::map<Client*, Listener> listeners;
  };

  void Apply(Member& member, const foxglove::Subscribe& message);
  void Apply(Member& member, const foxglove::Unsubscribe& message);
  void Apply(Member& member, const foxglove::Unsupported& message);
  static void Complain(Member& member, std::string_view message);

  const foxglove::ServerInfo info_;
  const std::function<void()> on_demand_;
  mutable std::mutex mutex_;
  foxglove::ChannelId next_channel_ = 1;
  std::map<foxglove::ChannelId, Topic> topics_;
  std::map<Client*, Member> members_;
  bool closed_ = false;
  CloseCode close_code_{};
  std::string close_reason_;
};

}  // namespace gsv::gateway
