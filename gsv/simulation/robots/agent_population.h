// The agents of all robots of a simulation, by the robot's name. It also calls the robots'
// behaviours.
//
// Threads  any. A function that is declared with GSV_REQUIRES(simulation_mutex) needs
//          SharedState::mutex.
#pragma once

#include <atomic>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "gsv/simulation/history/event_log.h"
#include "gsv/simulation/robots/behaviour_caller.h"
#include "gsv/simulation/robots/robot_agent.h"

namespace gsv::simulation {

// The agents of all robots of a simulation.
class AgentPopulation {
 public:
  using AgentPtr = std::shared_ptr<RobotAgent>;

  // `caller` must be closed before this population and the log are destroyed.
  AgentPopulation(std::shared_ptr<SharedState> shared, EventLog& events, BehaviourCaller& caller)
      : shared_(std::move(shared)), events_(events), caller_(caller) {}

  // Adds the agent of a robot. `behaviour` may be null.
  void Add(const std::string& name, std::shared_ptr<const model::Model> model, bool is_avatar,
           std::shared_ptr<BehaviourPort> behaviour) GSV_REQUIRES(simulation_mutex);
  // Ends the agent's current calls, then stops and destroys its behaviour.
  void Remove(const std::string& name) GSV_REQUIRES(simulation_mutex);
  // Replaces the agent's behaviour.
  void SetBehaviour(RobotAgent& agent, std::shared_ptr<BehaviourPort> behaviour)
      GSV_REQUIRES(simulation_mutex);
  // Sets, for each agent, the index of its robot's body in the layout.
  void AssignBodies(const world::Layout& layout) GSV_REQUIRES(simulation_mutex);

  const std::map<std::string, AgentPtr>& all() const GSV_REQUIRES(simulation_mutex) {
    return agents_;
  }
  AgentPtr Find(const std::string& name) const
      GSV_REQUIRES(simulation_mutex);  // Returns null if there is no agent with that name.
  // Returns the agents of robots that have a behaviour.
  std::vector<AgentPtr> WithBehaviour() const GSV_REQUIRES(simulation_mutex);
  // Whether a behaviour has ever run in this process.
  bool has_hosted() const { return has_hosted_; }

  // Posts a call to every behaviour. If a call fails, an event "behaviour_silent" names `what`.
  void CallAll(const char* what, base::Status (BehaviourPort::*call)())
      GSV_REQUIRES(simulation_mutex);
  // Ends all calls of agents with `reason` and stops the behaviours. If `is_stuck` is true,
  // behaviours in their turn are not stopped.
  void End(std::string reason, bool is_stuck) GSV_REQUIRES(simulation_mutex);
  void DestroyBehaviours() GSV_REQUIRES(simulation_mutex);
  // Resets all agents after the calls that End() posted have returned. Behaviours then wait for
  // Init().
  void Reset() GSV_REQUIRES(simulation_mutex);
  // Starts to check whether behaviours have died. A death is reported when the check of this
  // behaviour ends.
  void CheckForDeaths() GSV_REQUIRES(simulation_mutex);
  // Marks an agent as dead if the call of its behaviour failed.
  void ReportIfFailed(RobotAgent& agent, const char* what, const base::Status& status)
      GSV_EXCLUDES(simulation_mutex);

  // Returns the status of each robot.
  std::vector<RobotStatus> Statuses(const world::Snapshot& snapshot, SimTime stuck_after) const
      GSV_REQUIRES(simulation_mutex);
  // If the simulation has waited for a robot longer than 0.1 s, returns a text with the first such
  // robot (by name) and the time of the wait. Otherwise returns an empty text.
  std::string WaitingFor() const GSV_REQUIRES(simulation_mutex);

 private:
  // Reports the behaviour's death and emits an event.
  void ReportDeath(RobotAgent& agent, const std::string& detail) GSV_REQUIRES(simulation_mutex);

  const std::shared_ptr<SharedState> shared_;  // state shared by the parts of the simulation
  EventLog& events_;
  BehaviourCaller& caller_;
  std::map<std::string, AgentPtr> agents_ GSV_GUARDED_BY(simulation_mutex);
  // Robots whose behaviours have not yet answered IsDead().
  std::set<std::string> liveness_checks_ GSV_GUARDED_BY(simulation_mutex);
  std::atomic<bool> has_hosted_{false};  // see has_hosted()
};

}  // namespace gsv::simulation
