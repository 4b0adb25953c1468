// What is known of one simulation on another instance: its channels under our numbers, what we have
// subscribed to, and what we must remember for viewers who come late.
//
// Our number of a channel is also the number of our subscription to it.
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

  // Subscribes to what our viewers want, and to nothing else: the texts to be sent for that.
  std::vector<std::string> FollowDemand();
  // Those who subscribed to what we have already get it from memory.
  void ServeNewSubscribers();

  // The connection has ended: everything is withdrawn.
  void Clear();

 private:
  struct Source {
    foxglove::ChannelId theirs = 0;
    std::size_t memory = 1;  // how many messages a late viewer gets
    bool is_subscribed = false;
    std::deque<Hub::Message> latest;
  };
  void Welcome(foxglove::ChannelId ours, const Source& source);

  const std::shared_ptr<Hub> hub_;
  std::map<foxglove::ChannelId, Source> sources_;  // by our number
  std::map<foxglove::ChannelId, foxglove::ChannelId> ours_by_theirs_;
};

}  // namespace gsv::gateway::upstream
