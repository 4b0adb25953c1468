// The state that a simulation, its stepping thread and its agents share, under one mutex. The
// agents keep this state alive. So a call after the end of the simulation can still read that the
// simulation has ended.
#pragma once

#include <string>
#include <vector>

#include "gsv/base/mutex.h"
#include "gsv/simulation/history/motion_history.h"
#include "gsv/simulation/history/snapshot_history.h"
#include "gsv/simulation/robots/cycle_channel.h"
#include "gsv/simulation/robots/sensor_rack.h"
#include "gsv/simulation/robots/step_signal.h"
#include "gsv/simulation/robots/timer_queue.h"
#include "gsv/simulation/types.h"

namespace gsv::simulation {

class RobotAgent;

// Represents SharedState::mutex in the thread-safety analysis. Parts of a simulation have separate
// pointers to the state, and the analysis cannot know that they are equal.
class GSV_CAPABILITY("mutex") SimulationMutex {
 public:
  // Declares to the analysis that the calling thread holds the mutex. Checks nothing at run time.
  void AssertHeld() const GSV_ASSERT_HELD(this) {}
};
inline SimulationMutex simulation_mutex;

// The shared state, its mutex, and parts that have their own locks.
struct SharedState {
  SharedState(std::shared_ptr<const world::Snapshot> initial, Mode m, std::uint64_t s,
              std::shared_ptr<const sensing::SensorRegistry> types)
      : history(std::move(initial)), designs(std::move(types)), mode(m), seed(s) {}

  // The next members have their own locks.
  SnapshotHistory history;
  sensing::RaySceneCache rays;  // ray scenes for all sensors of the simulation
  SensorDesigns designs;        // the sensors of each model
  const Mode mode;
  const std::uint64_t seed;  // seed of the noise of all sensors

  // The queue of calls that want to lock `mutex`, see AgentCallLock.
  base::Mutex line;
  base::Mutex mutex;  // guards the members that are GSV_GUARDED_BY(simulation_mutex)
  // Notifies the stepping thread that the phase changed, that the last running agent waits, or that
  // a local behaviour can continue.
  StepSignal changed;
  // The reason why calls of agents end; empty while they may continue.
  std::string end_reason GSV_GUARDED_BY(simulation_mutex);
  SimTime now GSV_GUARDED_BY(simulation_mutex){0};         // time of the latest step
  MotionHistory motions GSV_GUARDED_BY(simulation_mutex);  // recent motion of all robots

  // Whether the stepping thread takes several steps in a row. Requests that control the run wait
  // until it has taken these steps. So a request has the same result as between single steps.
  bool takes_many GSV_GUARDED_BY(simulation_mutex) = false;
  // number of threads in AwaitManySteps()
  int waiting_requests GSV_GUARDED_BY(simulation_mutex) = 0;
  base::ConditionVariable many_taken;  // notified when takes_many becomes false
  // If the stepping thread takes several steps at once, waits until they are taken. `lock` is
  // released during the wait.
  void AwaitManySteps(base::MutexLock& lock) GSV_NO_THREAD_SAFETY_ANALYSIS {
    if (!takes_many) return;
    ++waiting_requests;
    many_taken.wait(lock, [this]() GSV_NO_THREAD_SAFETY_ANALYSIS { return !takes_many; });
    --waiting_requests;
  }

  // Agents add themselves to the following counts, lists and queues. A function that removes an
  // agent from the world must remove it from them.
  //
  // The number of agents that block the next step.
  int running GSV_GUARDED_BY(simulation_mutex) = 0;
  // The channels of clients that exchange control cycles by shared memory.
  CycleChannels channels GSV_GUARDED_BY(simulation_mutex);
  // The agents that wait for an instant.
  TimerQueue<RobotAgent> sleepers GSV_GUARDED_BY(simulation_mutex);
  // The agents of local behaviours with one clock that wait for an instant. The thread that
  // executes the turn of such an agent also wakes it.
  TimerQueue<RobotAgent> turn_sleepers GSV_GUARDED_BY(simulation_mutex);
  // A command for the drive of an agent's robot.
  struct DriveOrder {
    RobotAgent* agent;
    world::DriveCommand command;
  };
  // Commands to drives for the next step, from the turns of local behaviours. There is at most one
  // for each agent. They apply before the commands of agents in `commanded`.
  std::vector<DriveOrder> drives GSV_GUARDED_BY(simulation_mutex);
  // Agents with other commands for the next step.
  std::vector<RobotAgent*> commanded GSV_GUARDED_BY(simulation_mutex);
  // The local behaviours that have a turn now.
  std::vector<RobotAgent*> ready GSV_GUARDED_BY(simulation_mutex);
  // The agents from turn_sleepers whose instant is reached. They still wait, so they do not count
  // in `running`.
  std::vector<RobotAgent*> due GSV_GUARDED_BY(simulation_mutex);
  bool has_turns() const GSV_REQUIRES(simulation_mutex) { return !ready.empty() || !due.empty(); }
  // Whether deaths of agents were reported since the stepping thread last woke agents. Such an agent
  // no longer counts in `running`. But its death takes effect only in RobotAgent::Wake(). So in
  // lockstep, no step begins before the stepping thread has woken all agents.
  bool has_reported_deaths GSV_GUARDED_BY(simulation_mutex) = false;
  // Whether steps are timed, and the last robot for whose behaviour the step waited (empty if there
  // is none).
  bool is_timed GSV_GUARDED_BY(simulation_mutex) = false;
  std::string held_up_by GSV_GUARDED_BY(simulation_mutex);
  // The robots whose behaviours have given up, each with a sentence. The stepping thread emits an
  // event with this sentence.
  std::vector<std::pair<std::string, std::string>> given_up GSV_GUARDED_BY(simulation_mutex);
};

// A lock of SharedState::mutex for the lifetime of this object, except between unlock() and lock().
class GSV_SCOPED_CAPABILITY SimulationLock {
 public:
  explicit SimulationLock(SharedState& state) GSV_ACQUIRE(simulation_mutex) : lock_(state.mutex) {}
  ~SimulationLock() GSV_RELEASE() = default;
  SimulationLock(const SimulationLock&) = delete;
  SimulationLock& operator=(const SimulationLock&) = delete;

  // The thread-safety analysis is off here, because it knows the mutex only as simulation_mutex.
  void lock() GSV_ACQUIRE() GSV_NO_THREAD_SAFETY_ANALYSIS { lock_.lock(); }
  void unlock() GSV_RELEASE() GSV_NO_THREAD_SAFETY_ANALYSIS { lock_.unlock(); }
  // The lock that base::ConditionVariable needs.
  base::MutexLock& inner() { return lock_; }

 private:
  base::MutexLock lock_;
};

// A lock of SharedState::mutex for calls of agents. There may be a thousand such calls at once, so
// they first queue at `line`. The stepping thread locks the mutex directly. So the stepping thread
// waits for at most one of these calls.
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

  // The thread-safety analysis is off here, because it knows the mutex only as simulation_mutex.
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
  bool is_held_ = false;  // whether the mutex is locked
};

}  // namespace gsv::simulation
