// What a simulation, its stepping thread and its agents share, under one mutex. Agents hold it, so
// that a call that comes late finds an end instead of nothing.
#pragma once

#include <condition_variable>
#include <mutex>
#include <string>
#include <vector>

#include "gsv/simulation/robots/sensor_rack.h"
#include "gsv/simulation/robots/snapshot_history.h"
#include "gsv/simulation/robots/wake_calendar.h"
#include "gsv/simulation/types.h"

namespace gsv::simulation {

class RobotAgent;

struct SharedState {
  SharedState(std::shared_ptr<const world::Snapshot> initial, Mode m, std::uint64_t s,
              std::shared_ptr<const sensing::SensorRegistry> types)
      : history(std::move(initial)), designs(std::move(types)), mode(m), seed(s) {}

  // These have their own locks.
  SnapshotHistory history;
  sensing::RaySceneCache rays;
  SensorDesigns designs;
  const Mode mode;
  const std::uint64_t seed;

  // For agents' calls, of which there may be a thousand at once: they queue up before the mutex, so
  // that the stepping thread, which takes it directly, finds one of them before it at most.
  std::unique_lock<std::mutex> LockForAgent() {
    const std::lock_guard first_in_line(line);
    return std::unique_lock(mutex);
  }

  std::mutex line;
  std::mutex mutex;
  // For the stepping thread: the phase changed, the last agent that it waited for has begun to
  // wait, or a local behaviour can go on.
  std::condition_variable changed;
  std::string end_reason;  // not empty: agents' calls end with it
  SimTime now{0};

  // Agents enter themselves here; whoever takes one out of the world removes it.
  int running = 0;                     // agents that hold up the simulation
  WakeCalendar<RobotAgent> sleepers;   // who waits for an instant
  std::vector<RobotAgent*> commanded;  // have a command for the next step
  std::vector<RobotAgent*> ready;      // local behaviours whose turn it is
  bool has_reported_deaths = false;    // of agents that may be running
  // Robots whose behaviour has given up, and the sentence that the stepping thread is to tell.
  std::vector<std::pair<std::string, std::string>> given_up;
};

}  // namespace gsv::simulation
