// The HTTP API of a replay: the same addresses as a simulation's (docs/api.yaml), and
//   POST /api/simulations/NAME/seek   {"time_s": T}
//   POST /api/simulations/NAME/step   {"poses": N}, as well as {"count": N}
//   GET  /api/simulations/NAME/replay {"start_s", "end_s", "time_s", "speed", "loop"}
//   POST /api/simulations/NAME/replay {"speed": S, "loop": B}, both or one of them
//   GET  /api/simulations/NAME/events [{"time_s", "event", "robot", "detail"}]
//   GET  /api/simulations/NAME/log    [{"time_s", "level", "name", "text"}]
//   GET  /api/simulations/NAME/curve?topic=T&key=K&most=N   a value over the whole recording, read
//        in the background: {"time_s", "values", "samples", "is_whole", "done", "read_to_s",
//        "problem"}; robot=R in place of topic=T, or neither, see curves/curve_source.h
//
// A status also holds what GET replay gives. `stop` and `reset` both go back to the start.
//
// Threads  any.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "gsv/gateway/http/http.h"
#include "gsv/gateway/replay/replay_player.h"

namespace gsv::gateway {

class ReplayApi {
 public:
  // `player` must outlive this. `recording`: under which name a viewer can open the recording for
  // itself; empty: under none.
  explicit ReplayApi(ReplayPlayer& player, std::string recording = {})
      : player_(player), recording_(std::move(recording)) {}

  // `request.target` begins with "api".
  Response Handle(const Request& request);

 private:
  Response Server() const;
  Response OfSimulation(const Request& request);
  Response Act(const std::string& action, const std::string& body);
  Response Status() const;
  Response Replay(const Request& request);
  Response Topics(const std::string& robot);
  Response Events() const;
  Response Log() const;
  Response Curve(const Target& target) const;

  ReplayPlayer& player_;
  const std::string recording_;
};

// {"time_s": T}: a finite number, within the times there are.
base::Result<base::SimTime> ParseSeekTime(std::string_view body);

// {"speed": S, "loop": B}; what is absent stays as it is.
struct ReplayChange {
  std::optional<double> speed;
  std::optional<bool> loop;
};
base::Result<ReplayChange> ParseReplayChange(std::string_view body);

}  // namespace gsv::gateway
