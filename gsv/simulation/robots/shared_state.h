// What a simulation, its stepping thread and its agents share, under one mutex. Agents hold it, so
// that a call that comes late finds an end instead of nothing.
#pragma once

#include <string>
#include <vector>

#include "gsv/base/mutex.h"
#include "gsv/simulation/history/snapshot_history.h"
#include "gsv/simulation/robots/sensor_rack.h"
#include "gsv/simulation/robots/timer_queue.h"
#include "gsv/simulation/types.h"

namespace gsv::simulation {

class RobotAgent;

// SharedState::mutex, as the thread-safety analysis knows it: the parts of a simulation reach it
// each through a pointer of their own, and the analysis cannot tell that these are equal.
class GSV_CAPABILITY("mutex") SimulationMutex {
 public:
  // Tells the analysis that the calling thread holds the mutex; checks nothing.
  void AssertHeld() const GSV_ASSERT_HELD(this) {}
};
inline SimulationMutex simulation_mutex;

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

  // Taken through SimulationLock and AgentCallLock.
  base::Mutex line;
  base::Mutex mutex;
  // For the stepping thread: the phase changed, the last agent that it waited for has begun to
  // wait, or a local behaviour can go on.
  base::ConditionVariable changed;
  // Not empty: agents' calls end with it.
  std::string end_reason GSV_GUARDED_BY(simulation_mutex);
  SimTime now GSV_GUARDED_BY(simulation_mutex){0};

  // Agents enter themselves here; whoever takes one out of the world removes it.
  //
  // The number of agents that hold up the simulation.
  int running GSV_GUARDED_BY(simulation_mutex) = 0;
  // Who waits for an instant.
  TimerQueue<RobotAgent> sleepers GSV_GUARDED_BY(simulation_mutex);
  // Who has a command for the next step.
  std::vector<RobotAgent*> commanded GSV_GUARDED_BY(simulation_mutex);
  // Local behaviours whose turn it is.
  std::vector<RobotAgent*> ready GSV_GUARDED_BY(simulation_mutex);
  // Of agents that may be running.
  bool has_reported_deaths GSV_GUARDED_BY(simulation_mutex) = false;
  // Robots whose behaviour has given up, and the sentence that the stepping thread emits.
  std::vector<std::pair<std::string, std::string>> given_up GSV_GUARDED_BY(simulation_mutex);
};

// Holds SharedState::mutex as long as it lives, but for what lies between unlock() and lock().
class GSV_SCOPED_CAPABILITY SimulationLock {
 public:
  explicit SimulationLock(SharedState& state) GSV_ACQUIRE(simulation_mutex) : lock_(state.mutex) {}
  ~SimulationLock() GSV_RELEASE() = default;
  SimulationLock(const SimulationLock&) = delete;
  SimulationLock& operator=(const SimulationLock&) = delete;

  // The analysis knows the mutex as simulation_mutex.
  void lock() GSV_ACQUIRE() GSV_NO_THREAD_SAFETY_ANALYSIS { lock_.lock(); }
  void unlock() GSV_RELEASE() GSV_NO_THREAD_SAFETY_ANALYSIS { lock_.unlock(); }
  // For base::ConditionVariable.
  base::MutexLock& inner() { return lock_; }

 private:
  base::MutexLock lock_;
};

// The same for agents' calls, of which there may be a thousand at once: they queue up before the
// mutex, so that the stepping thread, which takes it directly, finds one of them before it at most.
class GSV_SCOPED_CAPABILITY AgentCallLock {
 public:
  explicit AgentCallLock(SharedState& state) GSV_ACQUIRE(simulation_mutex) : state_(state) {
    lock();
  }
  ~AgentCallLock() GSV_RELEASE() {
    if (is_held_) unlock();
  }
  AgentCallLock(const AgentCallLock&) = delete;
  AgentCallLock& operator=(const AgentCallLock&) = delete;

  // The analysis knows the mutex as simulation_mutex.
  void lock() GSV_ACQUIRE() GSV_NO_THREAD_SAFETY_ANALYSIS {
    const base::MutexLock first_in_line(state_.line);
    state_.mutex.lock();
    is_held_ = true;
  }
  void unlock() GSV_RELEASE() GSV_NO_THREAD_SAFETY_ANALYSIS {
    is_held_ = false;
    state_.mutex.unlock();
  }

 private:
  SharedState& state_;
  bool is_held_ = false;
};

}  // namespace gsv::simulation
