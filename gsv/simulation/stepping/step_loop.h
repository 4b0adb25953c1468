// The stepping thread of a simulation. For each step, it wakes agents and executes the turns of
// local behaviours. Then it waits until all agents wait (lockstep) or until the step is due (real
// time), and takes the step.
//
// Determinism  in lockstep no value depends on when calls arrive. A command is applied from the
//              instant at which its agent runs. Loops follow the order of names.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "gsv/base/thread_team.h"
#include "gsv/simulation/faults/fault_injector.h"
#include "gsv/simulation/history/snapshot_pool.h"
#include "gsv/simulation/pace/step_timer.h"
#include "gsv/simulation/robots/event_signaler.h"
#include "gsv/simulation/stepping/life_cycle.h"
#include "gsv/simulation/world/device_loop.h"

namespace gsv::simulation {

// The thread that takes the steps of a simulation.
class StepLoop {
 public:
  // The objects that the loop uses. All must outlive the loop.
  struct Parts {
    const Specification& specification;
    std::shared_ptr<SharedState> shared;  // state shared by the parts of the simulation
    EventLog& events;
    BehaviourCaller& caller;
    AgentPopulation& agents;
    LifeCycle& life_cycle;
    SimulatedWorld& world;
    FaultInjector& faults;
    std::shared_ptr<base::ThreadTeam> team;  // used only while the world's lock is held
  };

  // Starts the thread.
  explicit StepLoop(Parts parts);
  StepLoop(const StepLoop&) = delete;
  StepLoop& operator=(const StepLoop&) = delete;
  // Quit() and Join() must have been called.
  ~StepLoop() = default;
  // Makes the thread end after the current step.
  void Quit() GSV_REQUIRES(simulation_mutex);
  // Waits for the end of the thread. The caller must not hold a lock.
  void Join();

  // Returns a hash of the world, of the agents' waits and of the applied faults.
  std::string HashNow() const GSV_REQUIRES(world_mutex, simulation_mutex);

 private:
  // The main function of the thread.
  void Run();
  // Applies the faults that are due.
  void ApplyFaults();
  // Wakes the agents whose waits end now.
  void WakeAgents() GSV_REQUIRES(simulation_mutex);
  // Begins the cycles that clients have posted to shared memory, and sets when a client must ring.
  void TakeCycles() GSV_REQUIRES(simulation_mutex);
  // Signals the events in woken_. `lock` is released meanwhile.
  void OpenWoken(SimulationLock& lock) GSV_REQUIRES(simulation_mutex);
  // Ends the run, if the death of a behaviour must end it.
  void FailIfRequired(const RobotAgent& dead) GSV_REQUIRES(simulation_mutex);
  // Executes the turns of local behaviours until all of them wait.
  void TakeTurns();
  // The data of one thread of the team while it executes turns.
  struct alignas(64) TurnThread {
    std::optional<sensing::Sampling> sampling;  // at the instant of the turns
    std::size_t begin = 0, end = 0;             // executed turns that are not yet applied
  };
  // Any thread may call the next three functions, for different ranges of turns_.
  // Executes the turns from `begin` to `end`.
  void TakePiece(std::size_t begin, std::size_t end, TurnThread& thread);
  // Applies the executed turns of `thread` that ended in a wait for a later instant, and sets the
  // ends in results_. Then wakes the agents from `begin` to `end` of turns_, and sets the outcomes
  // in results_.
  void ApplyAndWake(std::size_t begin, std::size_t end, TurnThread& thread);
  // Adds an agent whose turn has ended to the lists of SharedState.
  void Enlist(RobotAgent& agent, const RobotAgent::UsualEnd& end) GSV_REQUIRES(simulation_mutex);
  // Sets SharedState::held_up_by to the robot whose turn took the longest. Does nothing if another
  // agent still delays the step.
  void NoteLongestTurn() GSV_REQUIRES(simulation_mutex);
  // Runs the work of Turn::Block() on another thread. The agent is then ready for its next turn.
  void PostBlocked(AgentPopulation::AgentPtr agent, std::function<void()> work);
  // Marks an agent as unresponsive, and fails the run if the specification requires it.
  void GiveUpOn(RobotAgent& agent) GSV_REQUIRES(simulation_mutex);
  // Returns true if every agent waits, and always in real time. Otherwise waits for a change and
  // returns false.
  bool AllWait(SimulationLock& lock) GSV_REQUIRES(simulation_mutex);
  // Returns true if the next step is due. Otherwise waits until it is due or something changes, and
  // returns false.
  bool IsDue(SimulationLock& lock) GSV_REQUIRES(simulation_mutex);
  // Takes one step, or several steps at once.
  void TakeStep();
  // Begins a step. Returns the maximum number of steps to take at once; 0 if no step may be taken.
  int BeginStep(WallTime start) GSV_REQUIRES(world_mutex);
  // Returns how many steps may be taken at once: nobody needs the states between these steps.
  int MaxSteps() const GSV_REQUIRES(world_mutex, simulation_mutex);
  // Returns whether the turns after `steps` steps will probably cast rays.
  bool WillCastRays(int steps) const GSV_REQUIRES(world_mutex, simulation_mutex);
  // Applies the agents' commands to the world.
  void ApplyCommands() GSV_REQUIRES(world_mutex, simulation_mutex);
  // Ends a step: publishes its snapshot and its times.
  void EndStep(const std::shared_ptr<const world::Snapshot>& snapshot, WallTime start, int steps)
      GSV_REQUIRES(world_mutex);

  const Parts parts_;                                   // the arguments of the constructor
  RunControl& run_ GSV_GUARDED_BY(simulation_mutex);    // the phase of the run
  bool quit_ GSV_GUARDED_BY(simulation_mutex) = false;  // set by Quit(); the thread then ends

  // Only the stepping thread uses the following members.
  SnapshotPool snapshots_;
  DeviceActions device_actions_;  // the actions for the next step
  Turn::Instant instant_;         // the instant of the current turns
  // The agents of the current turns. The first `awake_` agents are awake. The other agents must be
  // woken before their turns.
  std::vector<RobotAgent*> turns_;
  std::size_t awake_ = 0;
  // kNone: the agent was not woken, so it has no turn.
  enum class TurnOutcome : std::uint8_t { kTaken, kDied, kNone };
  // The result of a turn. Equal parts of turns_ have equal parts of results_, so each thread mostly
  // writes to its own cache lines.
  struct TurnResult {
    RobotAgent::UsualEnd end;  // how the turn ended, if it was applied
    TurnOutcome outcome;
  };
  std::vector<TurnResult> results_;       // one for each element of turns_
  std::vector<TurnThread> turn_threads_;  // one for each thread of the team
  EventSignaler event_signaler_;
  EventSignaler::Events woken_;  // wait events and channels of the agents that were just woken
  std::uint32_t mark_ = 0;       // StepSignal::mark() at the last TakeCycles()
  // whether the last TakeCycles() may have missed a client's ring
  bool may_have_missed_a_ring_ = false;
  // Whether the ray scene is prepared while the bodies move. Set by BeginStep().
  bool drafts_scene_ = false;
  bool is_timed_ = false;  // whether an observer requests the times of steps
  StepTimer timer_;

  std::jthread thread_;  // executes Run()
};

}  // namespace gsv::simulation
