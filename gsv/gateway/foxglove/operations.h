// What the clients of a hub can do besides listening: services, parameters, a playback's control.
//
// Threads  any; no call blocks. What takes longer is done elsewhere and answered later.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "gsv/base/error.h"
#include "gsv/gateway/foxglove/foxglove_requests.h"

namespace gsv::gateway {

class Operations {
 public:
  // The bytes of the response, in CDR; an error is why there is none.
  using Answer = std::function<void(const base::Result<std::vector<std::byte>>&)>;

  virtual ~Operations() = default;

  virtual std::vector<foxglove::Service> services() const = 0;
  // `answer` is called once, here or later, from any thread.
  virtual void Call(const foxglove::ServiceCall& call, Answer answer) = 0;

  virtual std::vector<foxglove::Parameter> parameters() const = 0;
  // Errors: a parameter that is not there, is fixed, or cannot have that value.
  virtual base::Status Set(const foxglove::Parameter& parameter) = 0;

  // Of playbacks only: how it stands.
  virtual std::optional<foxglove::PlaybackState> playback() const { return std::nullopt; }
  virtual base::Status Control(const foxglove::PlaybackControl& request);
};

inline base::Status Operations::Control(const foxglove::PlaybackControl&) {
  return base::Fail(base::ErrorCode::kInvalidArgument, "there is no playback here to control");
}

}  // namespace gsv::gateway
