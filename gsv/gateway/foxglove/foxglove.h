// Writes messages of the Foxglove WebSocket protocol, version 1: text messages, and headers of
// binary messages.
//
// Source  https://github.com/foxglove/ws-protocol/blob/main/docs/spec.md. `foxglove.sdk.v1` is the
//         name under which Foxglove's later SDK speaks the same messages.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "gsv/base/error.h"

namespace gsv::gateway::foxglove {

// The supported subprotocols, in the order of the server's preference.
inline constexpr std::array<std::string_view, 2> kSubprotocols{"foxglove.sdk.v1",
                                                               "foxglove.websocket.v1"};

// Chooses a subprotocol from a Sec-WebSocket-Protocol header; empty if there is no common
// subprotocol.
std::string_view ChooseSubprotocol(std::string_view offered);

using ChannelId = std::uint32_t;
using SubscriptionId = std::uint32_t;

// A channel of the protocol: a topic with its message type.
struct Channel {
  ChannelId id = 0;
  std::string topic;            // "/gsv/poses"
  std::string encoding;         // "cdr"
  std::string schema_name;      // "gsv_msgs/msg/Poses"
  std::string schema_encoding;  // "ros2msg"
  std::string schema;           // the text of the message definition
};

// The time range of a playback, in nanoseconds.
struct TimeRange {
  std::uint64_t start_ns = 0, end_ns = 0;
};

// The first message that a client receives.
struct ServerInfo {
  std::string name;
  std::vector<std::string> capabilities;  // the protocol's names of optional features
  // Names and values that the protocol does not define.
  std::map<std::string, std::string> metadata;
  std::string session_id;  // changes when the server restarts
  // The time range of the playback. If it is set, the server info also has the capability
  // playbackControl.
  std::optional<TimeRange> playback{};
};

enum class StatusLevel { kInfo = 0, kWarning = 1, kError = 2 };

// These functions write messages from the server to a client.
std::string ServerInfoText(const ServerInfo& info);
std::string AdvertiseText(std::span<const Channel> channels);
std::string UnadvertiseText(std::span<const ChannelId> channels);
// `id` identifies the status for RemoveStatusText(). A status with an empty id cannot be removed.
std::string StatusText(StatusLevel level, std::string_view message, std::string_view id = {});
std::string RemoveStatusText(std::string_view id);
// The id of the status message that says that the connection to the client is slow.
inline constexpr std::string_view kSlowConnectionId = "gsv-slow-connection";

// The header of a binary message, little endian: opcode (1 byte), subscription (4 bytes, not in
// every message) and time in nanoseconds (8 bytes).
struct BinaryHeader {
  std::array<std::uint8_t, 13> bytes{};
  std::uint8_t size = 0;
};
// The headers of a message of a subscription, and of a message with the present time.
BinaryHeader MessageDataHeader(SubscriptionId subscription, std::uint64_t time_ns);
BinaryHeader TimeHeader(std::uint64_t time_ns);

}  // namespace gsv::gateway::foxglove
