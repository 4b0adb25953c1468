// Checks once a second whether behaviours have died, and whether a turn of a behaviour in this
// process exceeds the deadline. If a turn exceeds the deadline, the simulation fails, see
// world_lock.h.
#pragma once

#include <chrono>
#include <memory>
#include <thread>

#include "gsv/simulation/stepping/life_cycle.h"

namespace gsv::simulation {

// A thread that detects dead behaviours, and behaviours that do not return.
class Watchdog {
 public:
  // Starts the watchdog. A turn may last at most `deadline`.
  Watchdog(std::chrono::milliseconds deadline, WorldLock& world_lock,
           std::shared_ptr<SharedState> shared, EventLog& events, AgentPopulation& agents,
           LifeCycle& life_cycle);
  // Stops the watchdog's thread.
  void Stop();

 private:
  // The main function of the thread.
  void Run();
  // Whether the run is starting, running or paused.
  bool IsUnderWay() const GSV_REQUIRES(simulation_mutex);
  // Fails the run if a behaviour has not returned from its turn within the deadline.
  void CheckTurnDeadlines() GSV_REQUIRES(simulation_mutex);

  const std::chrono::milliseconds deadline_;  // maximum duration of a turn
  WorldLock& world_lock_;
  const std::shared_ptr<SharedState> shared_;  // state shared by the parts of the simulation
  EventLog& events_;
  AgentPopulation& agents_;
  LifeCycle& life_cycle_;
  bool quit_ GSV_GUARDED_BY(simulation_mutex) = false;  // set by Stop(); the thread then ends
  base::ConditionVariable stopped_;                     // notified by Stop()
  std::jthread thread_;
};

}  // namespace gsv::simulation
