// Carries out the decisions of RunControl: starts and stops behaviours, emits events, schedules
// real time, and wakes threads that wait for a phase.
//
// Threads  any. A function that is declared with GSV_REQUIRES(simulation_mutex) needs
//          SharedState::mutex.
#pragma once

#include <chrono>
#include <memory>
#include <string>
#include <vector>

#include "gsv/simulation/history/event_log.h"
#include "gsv/simulation/pace/run_pace.h"
#include "gsv/simulation/robots/agent_population.h"
#include "gsv/simulation/stepping/run_control.h"
#include "gsv/simulation/world/world_lock.h"

namespace gsv::simulation {

// Starts, pauses, stops and resets a run as RunControl decides.
class LifeCycle {
 public:
  // All arguments except the specification must outlive the life cycle. The BehaviourCaller must be
  // closed before this object is destroyed.
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

  // The state machine of the run: its phase, and the changes that are allowed in it.
  RunControl& run() GSV_REQUIRES(simulation_mutex) { return run_; }
  const RunControl& run() const GSV_REQUIRES(simulation_mutex) { return run_; }
  RunPace& pace() GSV_REQUIRES(simulation_mutex) { return pace_; }
  const RunPace& pace() const GSV_REQUIRES(simulation_mutex) { return pace_; }

  // Carries out a change that run() returned. `detail` becomes the detail of the change's event.
  void Apply(RunControl::Change change, const std::string& detail = {})
      GSV_REQUIRES(simulation_mutex);
  // Ends the run in the phase "failed".
  void Fail(const std::string& reason) GSV_REQUIRES(simulation_mutex);
  // Begins a reset. Returns false if there is nothing to reset.
  bool BeginReset() GSV_REQUIRES(simulation_mutex);
  // Ends a reset. Call it when everything else has been reset.
  void FinishReset() GSV_REQUIRES(simulation_mutex);

  // Starts behaviours. The run begins when all of them have answered.
  void StartBehaviours(const std::vector<AgentPopulation::AgentPtr>& agents)
      GSV_REQUIRES(simulation_mutex);
  // Stops all behaviours and ends the calls of agents with `reason`.
  void EndBehaviours(std::string reason) GSV_REQUIRES(simulation_mutex);

  // See Simulation::WaitForPhase().
  Phase WaitForPhase(const std::vector<Phase>& phases, std::chrono::milliseconds timeout) const;

 private:
  // Wakes the threads in WaitForPhase().
  void NotifyPhase() GSV_REQUIRES(simulation_mutex);

  RunControl run_ GSV_GUARDED_BY(simulation_mutex);  // the phase of the run
  RunPace pace_ GSV_GUARDED_BY(simulation_mutex);    // the real-time schedule of the run
  const WorldLock& world_lock_;
  const std::shared_ptr<SharedState> shared_;  // state shared by the parts of the simulation
  EventLog& events_;
  AgentPopulation& agents_;
  BehaviourCaller& caller_;
  mutable base::ConditionVariable phase_changed_;  // notified when the phase changes
};

}  // namespace gsv::simulation
