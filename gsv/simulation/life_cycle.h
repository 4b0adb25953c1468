// Acts on what RunControl decides: starts and stops behaviours, emits events, keeps the pace and
// wakes the threads that wait for a phase.
//
// Threads  every member needs SharedState::mutex, except where it says otherwise.
#pragma once

#include <chrono>
#include <condition_variable>
#include <memory>
#include <string>
#include <vector>

#include "gsv/simulation/event_log.h"
#include "gsv/simulation/pace/run_pace.h"
#include "gsv/simulation/robots/agent_population.h"
#include "gsv/simulation/run_control.h"
#include "gsv/simulation/world_lock.h"

namespace gsv::simulation {

class LifeCycle {
 public:
  // All but the specification outlive the life cycle; the caller is closed before it ends.
  LifeCycle(const Specification& specification, const WorldLock& world_lock,
            std::shared_ptr<SharedState> shared, EventLog& events, AgentPopulation& agents,
            BehaviourCaller& caller)
      : run_(specification.name, specification.duration),
        pace_(specification.step, specification.factor),
        world_lock_(world_lock),
        shared_(std::move(shared)),
        events_(events),
        agents_(agents),
        caller_(caller) {}

  RunControl& run() { return run_; }
  const RunControl& run() const { return run_; }
  RunPace& pace() { return pace_; }
  const RunPace& pace() const { return pace_; }

  // Does what a change of run() entails. `detail` is that of its event.
  void Apply(RunControl::Change change, const std::string& detail = {});
  void Fail(const std::string& reason);
  // The first half of a reset. False: there is nothing to reset.
  bool BeginReset();
  // The second half; what else is to be reset has been.
  void FinishReset();

  // Starts behaviours; the run begins when all that are being started have answered.
  void StartBehaviours(const std::vector<AgentPopulation::AgentPtr>& agents);
  void EndBehaviours(std::string reason);

  // Takes the mutex itself; see Simulation.
  Phase WaitForPhase(const std::vector<Phase>& phases, std::chrono::milliseconds timeout) const;

 private:
  void NotifyPhase();

  RunControl run_;
  RunPace pace_;
  const WorldLock& world_lock_;
  const std::shared_ptr<SharedState> shared_;
  EventLog& events_;
  AgentPopulation& agents_;
  BehaviourCaller& caller_;
  mutable std::condition_variable phase_changed_;
};

}  // namespace gsv::simulation
