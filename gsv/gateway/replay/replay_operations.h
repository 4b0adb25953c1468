// ReplayOperations offers the operations on a replay to its viewers: the services of a running
// simulation, the parameters speed and loop, and playback control.
//
// Threads  any.
#pragma once

#include "gsv/gateway/foxglove/operations.h"
#include "gsv/gateway/live/command_services.h"

namespace gsv::gateway {

class ReplayPlayer;

// The operations on a replay.
class ReplayOperations final : public Operations {
 public:
  // `player` must outlive the last call.
  explicit ReplayOperations(ReplayPlayer& player);

  std::vector<foxglove::Service> services() const override { return services_.list(); }
  void Call(const foxglove::ServiceCall& call, Answer answer) override;
  std::vector<foxglove::Parameter> parameters() const override;
  base::Status Set(const foxglove::Parameter& parameter) override;
  std::optional<foxglove::PlaybackState> playback() const override;
  base::Status Control(const foxglove::PlaybackControl& request) override;

 private:
  ReplayPlayer& player_;
  const CommandServices services_;
};

}  // namespace gsv::gateway
