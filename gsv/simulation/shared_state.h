// What a simulation, its stepping thread and its agents share, under one mutex. Agents hold it, so
// that a call that comes late finds an end instead of nothing.
#pragma once

#include <condition_variable>
#include <mutex>
#include <string>

#include "gsv/simulation/sensor_rack.h"
#include "gsv/simulation/snapshot_history.h"
#include "gsv/simulation/types.h"

namespace gsv::simulation {

class RobotAgent;

struct SharedState {
  SharedState(std::shared_ptr<const world::Snapshot> initial, Mode m, std::uint64_t s)
      : history(std::move(initial)), mode(m), seed(s) {}

  // These have their own locks.
  SnapshotHistory history;
  sensing::RaySceneCache rays;
  const Mode mode;
  const std::uint64_t seed;

  std::mutex mutex;
  // The phase changed, or the agent that `holdup` names has begun to wait.
  std::condition_variable changed;
  const RobotAgent* holdup = nullptr;
  Phase phase = Phase::kCreated;
  std::string end_reason;  // not empty: agents' calls end with it
  SimTime now{0};
};

}  // namespace gsv::simulation
