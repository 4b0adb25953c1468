#include "gsv/simulation/stepping/life_cycle.h"

#include <algorithm>
#include <utility>

namespace gsv::simulation {

void LifeCycle::NotifyPhase() {
  pace_.SetRunning(run_.is_running(), shared_->now);
  shared_->changed.notify_all();
  phase_changed_.notify_all();
}

void LifeCycle::Apply(RunControl::Change change, const std::string& detail) {
  using Change = RunControl::Change;
  if (change == Change::kNone) return;
  NotifyPhase();
  switch (change) {
    case Change::kNone:
    case Change::kRunning:
      return;
    case Change::kStarted:
      events_.Emit("started", {}, detail);
      [[fallthrough]];
    case Change::kResumed: {
      std::vector<AgentPopulation::AgentPtr> waiting = agents_.WithBehaviour();
      std::erase_if(waiting, [](const auto& agent)
                                 GSV_REQUIRES(simulation_mutex) { return agent->is_started(); });
      StartBehaviours(waiting);
      return Apply(run_.RunIfStarted());
    }
    case Change::kPaused:
      return events_.Emit("paused", {}, detail);
    case Change::kStopped:
      events_.Emit("stopped", {}, detail);
      return EndBehaviours("the simulation has been stopped");
    case Change::kFinished:
      events_.Emit("finished", {}, detail);
      return EndBehaviours("the simulation has finished");
    case Change::kFailed:
      events_.Emit("failed", {}, detail);
      return EndBehaviours("the simulation has failed: " + detail);
  }
}

void LifeCycle::Fail(const std::string& reason) { Apply(run_.Fail(reason), reason); }

bool LifeCycle::BeginReset() {
  if (run_.BeginReset() == RunControl::Change::kNone) return false;
  NotifyPhase();
  EndBehaviours("the simulation is being reset");
  return true;
}

void LifeCycle::FinishReset() {
  run_.FinishReset();
  pace_.Reset();
  NotifyPhase();
  events_.Emit("reset");
}

void LifeCycle::StartBehaviours(const std::vector<AgentPopulation::AgentPtr>& agents) {
  for (const AgentPopulation::AgentPtr& agent : agents) {
    agent->MarkStarted();
    run_.BeginStart();
    caller_.Post(agent->robot(), [this, agent, behaviour = agent->behaviour()] {
      const base::Status status = behaviour->Start();
      agents_.ReportIfFailed(*agent, "start", status);
      const SimulationLock lock(*shared_);
      agent->MarkStarted();
      if (status && behaviour->local() != nullptr) agent->MakeReady();
      run_.EndStart();
      Apply(run_.RunIfStarted());
    });
  }
}

void LifeCycle::EndBehaviours(std::string reason) {
  agents_.End(std::move(reason), world_lock_.is_stuck());
}

Phase LifeCycle::WaitForPhase(const std::vector<Phase>& phases,
                              std::chrono::milliseconds timeout) const {
  SimulationLock lock(*shared_);
  phase_changed_.wait_for(lock.inner(), timeout, [&]() GSV_REQUIRES(simulation_mutex) {
    return std::find(phases.begin(), phases.end(), run_.phase()) != phases.end();
  });
  return run_.phase();
}

}  // namespace gsv::simulation
