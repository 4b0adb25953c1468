// Parses the messages of clients in the Foxglove WebSocket protocol (see foxglove.h).
//
// Input  untrusted, limited by the size of a message.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "gsv/base/error.h"
#include "gsv/gateway/foxglove/foxglove.h"
#include "gsv/gateway/foxglove/foxglove_operations.h"

namespace gsv::gateway::foxglove {

// The messages of clients, and their parts.

// A subscription to a channel. The client chooses its id.
struct Subscription {
  SubscriptionId id = 0;
  ChannelId channel = 0;
};
// Begins subscriptions.
struct Subscribe {
  std::vector<Subscription> subscriptions;
};
// Ends subscriptions.
struct Unsubscribe {
  std::vector<SubscriptionId> subscriptions;
};
// Requests the values of parameters.
struct GetParameters {
  std::vector<std::string> names;  // empty: all parameters
  std::string request;             // id of the request, which is returned with the answer
};
// Changes parameters.
struct SetParameters {
  std::vector<Parameter> parameters;
  std::string request;
};
// Starts or stops watching parameters. A client that watches a parameter gets each change of it.
struct WatchParameters {
  std::vector<std::string> names;  // empty: all parameters
  bool is_end = false;             // whether the client stops watching
};
// Starts or stops watching the connection graph.
struct WatchGraph {
  bool is_end = false;
};
// A call of a service; `call` identifies its response.
struct ServiceCall {
  std::uint32_t service = 0;  // number of the advertised service
  std::uint32_t call = 0;     // number that the client has chosen
  std::string encoding;
  std::string request;  // the bytes of the request, in this encoding
};
// A request to play or pause a replay, with a speed and perhaps a time to seek to.
struct PlaybackControl {
  bool play = false;                     // true for play, false for pause
  float speed = 1;                       // recorded seconds per second
  std::optional<std::uint64_t> seek_ns;  // time to seek to; nullopt: no seek
  std::string request;
};
// Requests the images of a view, which the server draws. This is an extension of the protocol
// (docs/formats/live.md).
struct WatchView {
  SubscriptionId id = 0;       // id of the view, which the client chooses
  std::string camera;          // parameters as in the query of /view.mjpeg
  std::uint32_t sequence = 0;  // number of this camera, which is sent back with each of its images
};
// Ends a view.
struct UnwatchView {
  SubscriptionId id = 0;
};
// The client has shown an image, or has skipped it.
struct ViewShown {
  SubscriptionId id = 0;
  std::uint64_t image = 0;  // number of the image, see kImageHeaderSize
};
// A message of an unsupported capability.
struct Unsupported {
  std::string op;  // the protocol's name of the message
};
using ClientMessage =
    std::variant<Subscribe, Unsubscribe, GetParameters, SetParameters, WatchParameters, WatchGraph,
                 ServiceCall, PlaybackControl, WatchView, UnwatchView, ViewShown, Unsupported>;

// These functions parse a text message and a binary message. They fail with kCorrupt for invalid
// messages.
base::Result<ClientMessage> ParseClientMessage(std::string_view text);
base::Result<ClientMessage> ParseClientBytes(std::string_view bytes);

}  // namespace gsv::gateway::foxglove
