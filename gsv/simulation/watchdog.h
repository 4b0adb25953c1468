// Looks after a simulation's behaviours once a second: which have died, and which, in process, do
// not return from their turn. A simulation with one of the latter fails: see world_lock.h.
#pragma once

#include <chrono>
#include <condition_variable>
#include <memory>
#include <thread>

#include "gsv/simulation/life_cycle.h"

namespace gsv::simulation {

class Watchdog {
 public:
  // Watches from now on. A turn may last as long as `deadline`.
  Watchdog(std::chrono::milliseconds deadline, WorldLock& world_lock,
           std::shared_ptr<SharedState> shared, EventLog& events, AgentPopulation& agents,
           LifeCycle& life_cycle);
  // Ends its thread.
  void Stop();

 private:
  void Run(const std::stop_token& stop);
  // These need SharedState::mutex.
  bool IsUnderWay() const;
  void LookForEndlessTurns();

  const std::chrono::milliseconds deadline_;
  WorldLock& world_lock_;
  const std::shared_ptr<SharedState> shared_;
  EventLog& events_;
  AgentPopulation& agents_;
  LifeCycle& life_cycle_;
  std::condition_variable_any stopped_;
  std::jthread thread_;
};

}  // namespace gsv::simulation
