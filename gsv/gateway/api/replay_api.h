// The HTTP API of a replay: the same addresses as a simulation's, and those that move it and show
// what the recording holds. A status also holds what GET replay gives. `stop` and `reset` both go
// back to the start; what would change the run is refused.
//
// Threads  any.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "gsv/gateway/http/route.h"
#include "gsv/gateway/replay/replay_player.h"

namespace gsv::gateway {

struct Replay {
  std::shared_ptr<ReplayPlayer> player;
  std::string recording;  // under which name a viewer can open it for itself; empty: under none
};

// The replay that a request concerns, found by whatever parameters its path has besides {name}.
using FindReplay = std::function<base::Result<Replay>(const Request&)>;

std::vector<Route> ReplayRoutes(const FindReplay& find);

// {"time_s": T}: a finite number, within the times there are.
base::Result<base::SimTime> ParseSeekTime(std::string_view body);

// {"speed": S, "loop": B}; what is absent stays as it is.
struct ReplayChange {
  std::optional<double> speed;
  std::optional<bool> loop;
};
base::Result<ReplayChange> ParseReplayChange(std::string_view body);

}  // namespace gsv::gateway
