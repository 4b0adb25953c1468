// The channels of a simulation on another instance with local numbers, the subscriptions there, and
// the messages kept for new subscribers.
//
// The local number of a channel is also the number of the subscription to it.
//
// Threads  one.
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

class ChannelMap {
 public:
  explicit ChannelMap(std::shared_ptr<Hub> hub) : hub_(std::move(hub)) {}

  void Take(const Advertise& message);
  void Take(const Unadvertise& message);
  void Take(const MessageData& message);

  // Makes the remote subscriptions equal to those of local viewers. Returns the texts to send.
  std::vector<std::string> FollowDemand();
  // Sends kept messages to new subscribers.
  void ServeNewSubscribers();

  // After the end of the connection: withdraws all channels.
  void Clear();

 private:
  struct Source {
    foxglove::ChannelId theirs = 0;
    std::size_t memory = 1;  // number of kept messages for a new subscriber
    bool is_subscribed = false;
    std::deque<Hub::Message> latest;
  };
  void Welcome(foxglove::ChannelId ours, const Source& source);

  const std::shared_ptr<Hub> hub_;
  std::map<foxglove::ChannelId, Source> sources_;  // sources by local number
  std::map<foxglove::ChannelId, foxglove::ChannelId> ours_by_theirs_;
};

}  // namespace gsv::gateway::upstream
