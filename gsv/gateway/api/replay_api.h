// The HTTP API of a replay: the addresses of a simulation, and those that control playback and
// describe the recording. A status also has the content of GET replay. `stop` and `reset` both
// return to the start. Requests that would change the run are refused.
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
  std::string recording;  // name with which a viewer can open it; empty: none
};

// Finds the replay of a request by the parameters of its path besides {name}.
using FindReplay = std::function<base::Result<Replay>(const Request&)>;

std::vector<Route> ReplayRoutes(const FindReplay& find);

// Parses {"time_s": T}, where T is a finite number within the range of times.
base::Result<base::SimTime> ParseSeekTime(std::string_view body);

// A change from {"speed": S, "loop": B}. Absent values are unchanged.
struct ReplayChange {
  std::optional<double> speed;
  std::optional<bool> loop;
};
base::Result<ReplayChange> ParseReplayChange(std::string_view body);

}  // namespace gsv::gateway
