// Writes messages of the Foxglove WebSocket protocol (see foxglove.h) about services, parameters,
// the connection graph and the playback.
//
// Source  services, parameters and the graph: the specification named in foxglove.h. Playback: the
//         messages of Foxglove's SDK under `foxglove.sdk.v1`.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace gsv::gateway::foxglove {

// The request or response of a service. Its schema is empty if it has no fields.
struct ServiceMessage {
  std::string schema_name;  // "std_srvs/srv/Trigger_Response"
  std::string schema;       // in the format ros2msg; the messages are CDR
};
// A service that clients can call.
struct Service {
  std::uint32_t id = 0;
  std::string name;  // "/gsv/pause"
  std::string type;  // "std_srvs/srv/Trigger"
  ServiceMessage request, response;
};

// The value of a parameter. It is std::monostate if its type is not supported.
using ParameterValue = std::variant<std::monostate, bool, double, std::string>;
struct Parameter {
  std::string name;
  ParameterValue value;

  friend bool operator==(const Parameter&, const Parameter&) = default;
};

// Publishers and subscribers by topic, and providers by service.
struct ConnectionGraph {
  // Names of nodes, by topic or service.
  using Parties = std::map<std::string, std::set<std::string>>;
  Parties publishers, subscribers, providers;
};

// The state of a playback; the speed is in recorded seconds per second.
struct PlaybackState {
  enum class Status : std::uint8_t { kPlaying = 0, kPaused = 1, kBuffering = 2, kEnded = 3 };
  Status status = Status::kPaused;
  std::uint64_t time_ns = 0;  // position in the recording
  float speed = 1;
  bool did_seek = false;  // whether the position has jumped since the last state
  std::string request;    // id of the request to which this is the answer; empty if there is none
};

// These functions write messages from the server to a client.
std::string AdvertiseServicesText(std::span<const Service> services);
std::string ServiceFailureText(std::uint32_t service, std::uint32_t call, std::string_view message);
// Reports why the server cannot draw a view. The view has ended.
std::string ViewFailureText(std::uint32_t view, std::string_view message);
std::string ParameterValuesText(std::span<const Parameter> parameters, const std::string& request);
// Returns the update from `before` to `after`; empty if they are equal.
std::string GraphUpdateText(const ConnectionGraph& before, const ConnectionGraph& after);
std::vector<std::byte> ServiceResponseBytes(std::uint32_t service, std::uint32_t call,
                                            std::span<const std::byte> response);
std::vector<std::byte> PlaybackStateBytes(const PlaybackState& state);

}  // namespace gsv::gateway::foxglove
