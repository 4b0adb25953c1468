// A ViewSource provides the state of a world that the server draws: a running simulation or a
// replay.
//
// Threads  one thread at a time.
#pragma once

#include <memory>

#include "gsv/base/error.h"
#include "gsv/gateway/replay/replay_player.h"
#include "gsv/simulation/simulation.h"
#include "gsv/view/camera.h"
#include "gsv/world/snapshot.h"

namespace gsv::gateway::drawing {

// The state of a world at one instant, ready to render.
struct ViewInstant {
  // The current snapshot. If anything has changed since the last Now(), this is another object.
  std::shared_ptr<const world::Snapshot> snapshot;
  view::SceneLookup lookup;  // valid until the next Now()
  base::SimTime time{};
};

// The interface for the state of a world that the server draws.
class ViewSource {
 public:
  virtual ~ViewSource() = default;
  // Fails with kEnded if the simulation does not exist any more, with kNotFound if a recording has
  // no scene.
  virtual base::Result<ViewInstant> Now() = 0;
};

// Makes the source for a running simulation. The source does not keep the simulation alive.
std::unique_ptr<ViewSource> MakeLiveSource(
    const std::shared_ptr<simulation::Simulation>& simulation);
// Makes the source for a replay.
std::unique_ptr<ViewSource> MakeReplaySource(std::shared_ptr<ReplayPlayer> player);

}  // namespace gsv::gateway::drawing
