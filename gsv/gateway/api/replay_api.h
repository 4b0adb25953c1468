// The HTTP API of a replay. It has the same addresses as the API of a simulation, and further
// addresses that control the playback and describe the recording. The status of a replay also has
// the member "replay": the same object as the response to GET …/replay. Both `stop` and `reset`
// return to the start. Requests that would change the recorded run are refused.
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

// A replay that the API serves.
struct Replay {
  std::shared_ptr<ReplayPlayer> player;
  std::string recording;  // see ReplaySessions::Add(); may be empty
};

// Finds the replay to which a request refers. It may use the parameters of the request's path, but
// not {name}: ReplayRoutes() compares {name} with the name of the recorded simulation.
using FindReplay = std::function<base::Result<Replay>(const Request&)>;

// Returns the routes of the API. For each request, they call `find` to get the replay.
std::vector<Route> ReplayRoutes(const FindReplay& find);

// Parses {"time_s": T}: a time in simulated seconds, finite and within the range of SimTime.
base::Result<base::SimTime> ParseSeekTime(std::string_view body);

// The change that the body {"speed": S, "loop": B} requests. Absent values stay unchanged.
struct ReplayChange {
  std::optional<double> speed;  // simulated seconds per second of wall-clock time
  std::optional<bool> loop;     // whether to restart at the end
};
// Parses {"speed": S, "loop": B}. Both keys are optional.
base::Result<ReplayChange> ParseReplayChange(std::string_view body);

}  // namespace gsv::gateway
