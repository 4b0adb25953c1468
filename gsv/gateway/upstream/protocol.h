// The client's side of the Foxglove WebSocket protocol: parses the server's messages and writes the
// client's messages (see gsv/gateway/foxglove/foxglove.h).
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "gsv/gateway/foxglove/foxglove_requests.h"

namespace gsv::gateway::upstream {

// The text messages of a server.
struct Advertise {
  std::vector<foxglove::Channel> channels;
};
struct Unadvertise {
  std::vector<foxglove::ChannelId> channels;
};
struct StatusMessage {
  foxglove::StatusLevel level = foxglove::StatusLevel::kInfo;
  std::string message;
};
struct Other {};  // any other message, which is ignored
using ServerText = std::variant<Advertise, Unadvertise, StatusMessage, Other>;

// Fails with kCorrupt for invalid messages.
base::Result<ServerText> ParseServerText(std::string_view text);

// The binary messages of a server.
struct MessageData {
  foxglove::SubscriptionId subscription = 0;
  std::uint64_t time_ns = 0;
  std::string_view payload;
};
// The simulated time of the server.
struct Time {
  std::uint64_t time_ns = 0;
};
using ServerData = std::variant<MessageData, Time, Other>;

// The payload points into `bytes`.
base::Result<ServerData> ParseServerData(std::string_view bytes);

std::string SubscribeText(std::span<const foxglove::Subscription> subscriptions);
std::string UnsubscribeText(std::span<const foxglove::SubscriptionId> subscriptions);

}  // namespace gsv::gateway::upstream
