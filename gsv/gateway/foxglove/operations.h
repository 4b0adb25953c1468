// Operations is the interface for what a hub's clients can request besides subscriptions: services,
// parameters and playback control.
//
// Threads  any; no call blocks. Slow operations run elsewhere and answer later.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "gsv/base/error.h"
#include "gsv/gateway/foxglove/foxglove_requests.h"

namespace gsv::gateway {

// The interface for the operations on a simulation that a hub's clients can request.
class Operations {
 public:
  // The response in CDR, or an error.
  using Answer = std::function<void(const base::Result<std::vector<std::byte>>&)>;

  virtual ~Operations() = default;

  // The services that clients can call.
  virtual std::vector<foxglove::Service> services() const = 0;
  // Calls `answer` exactly once, before it returns or later from any thread.
  virtual void Call(const foxglove::ServiceCall& call, Answer answer) = 0;

  // The parameters and their values.
  virtual std::vector<foxglove::Parameter> parameters() const = 0;
  // Fails for an unknown or fixed parameter, or an invalid value.
  virtual base::Status Set(const foxglove::Parameter& parameter) = 0;

  // Returns the state of a playback; nullopt for a running simulation.
  virtual std::optional<foxglove::PlaybackState> playback() const { return std::nullopt; }
  // Plays, pauses or seeks a replay.
  virtual base::Status Control(const foxglove::PlaybackControl& request);
};

inline base::Status Operations::Control(const foxglove::PlaybackControl&) {
  return base::Fail(base::ErrorCode::kInvalidArgument,
                    "this server has no playback; only replays have one");
}

}  // namespace gsv::gateway
