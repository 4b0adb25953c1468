// A ChannelMap maps the channels of a simulation on another instance to channels of a local hub. It
// also manages the subscriptions at the other instance, and keeps messages for new subscribers.
//
// The local number of a channel is also the id of the subscription at the other instance.
//
// Threads  one thread.
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "gsv/gateway/foxglove/hub.h"
#include "gsv/gateway/upstream/protocol.h"

namespace gsv::gateway::upstream {

// Maps the channels of another instance to channels of a local hub.
class ChannelMap {
 public:
  explicit ChannelMap(std::shared_ptr<Hub> hub) : hub_(std::move(hub)) {}

  // Processes a message from the other instance.
  void Handle(const Advertise& message);
  void Handle(const Unadvertise& message);
  void Handle(const MessageData& message);

  // Makes the remote subscriptions equal to the subscriptions of local viewers. Returns the texts
  // to send.
  std::vector<std::string> FollowDemand();
  // Sends kept messages to new subscribers.
  void ServeNewSubscribers();

  // Withdraws all channels, after the end of the connection.
  void Clear();

 private:
  // A channel of the other instance.
  struct Source {
    foxglove::ChannelId theirs = 0;   // number of the channel at the other instance
    std::size_t memory = 1;           // number of kept messages for a new subscriber
    bool is_subscribed = false;       // whether this program subscribes to it at the other instance
    std::deque<Hub::Message> latest;  // the kept messages
  };
  // Sends the kept messages to new subscribers of the local channel `ours`.
  void Welcome(foxglove::ChannelId ours, const Source& source);

  const std::shared_ptr<Hub> hub_;
  std::map<foxglove::ChannelId, Source> sources_;  // sources by local number
  // The local number of each channel of the other instance.
  std::map<foxglove::ChannelId, foxglove::ChannelId> ours_by_theirs_;
};

}  // namespace gsv::gateway::upstream
