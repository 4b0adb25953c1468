// The Simulation there is: a thread that steps a dynamics engine and wakes agents.
//
// Locks, in the order in which they are taken: control_mutex_ (one control action at a time),
// world_mutex_ (the engine, the layout and the state), SharedState::mutex (phase and agents),
// events_mutex_. No lock is held across a call to a behaviour, except control_mutex_, and except
// world_mutex_ during the turns of behaviours in process: others take that by LockWorld().
#pragma once

#include <deque>
#include <functional>
#include <map>
#include <set>
#include <thread>

#include "gsv/base/thread_team.h"
#include "gsv/dynamics/motion/engine.h"
#include "gsv/simulation/attachments.h"
#include "gsv/simulation/device_loop.h"
#include "gsv/simulation/pace/pacer.h"
#include "gsv/simulation/pace/run_statistics.h"
#include "gsv/simulation/robots/behaviour_caller.h"
#include "gsv/simulation/robots/gate_opener.h"
#include "gsv/simulation/robots/robot_agent.h"
#include "gsv/simulation/simulation.h"
#include "gsv/simulation/snapshot_pool.h"
#include "gsv/world/wheel_odometry.h"

namespace gsv::simulation {

std::string PlaceText(const geometry::Pose& pose);  // "(1, 2)"
std::string SourceOf(const model::Model& model);    // its file, or its name if it has none

class SteppingSimulation final : public Simulation {
 public:
  SteppingSimulation(Specification specification,
                     std::shared_ptr<const sensing::SensorRegistry> sensors,
                     std::shared_ptr<base::ThreadTeam> team,
                     std::unique_ptr<dynamics::Engine> engine,
                     std::shared_ptr<const world::Layout> layout);
  ~SteppingSimulation() override;
  // Destroys it, or, where a behaviour in process does not return, leaves it to itself.
  static void Dispose(SteppingSimulation* simulation);

  base::Result<std::vector<std::string>> AddRobots(std::vector<RobotSpecification> robots) override;
  base::Status RemoveRobot(const std::string& name) override;
  base::Result<std::string> AddObject(ObjectSpecification object) override;
  base::Status RemoveObject(const std::string& name) override;
  base::Status PlaceBody(const std::string& name, const geometry::Pose& world_from_body,
                         bool on_ground) override;
  base::Status SetBehaviour(const std::string& robot,
                            std::shared_ptr<BehaviourPort> behaviour) override;

  base::Status CommandJoint(const std::string& body, const std::string& joint,
                            const world::JointCommand& command) override;

  base::Status Start() override;
  base::Status Pause() override;
  base::Status Resume() override;
  base::Status Step(std::int64_t count) override;
  base::Status RunUntil(SimTime until) override;
  base::Status RunThrough(SimTime until) override;
  base::Status Stop() override;
  base::Status Reset() override;
  base::Status SetFactor(double factor) override;
  double factor() const override;

  const Specification& specification() const override { return specification_; }
  SimulationStatus status() const override;
  std::shared_ptr<const world::Snapshot> snapshot() const override {
    return shared_->history.latest();
  }
  std::string state_hash() const override;
  Phase WaitForPhase(const std::vector<Phase>& phases,
                     std::chrono::milliseconds timeout) const override;

  std::shared_ptr<Agent> agent(const std::string& robot) const override;
  base::Result<sensing::Reading> Watch(const std::string& robot,
                                       const std::string& sensor) override;
  std::vector<model::SensorDescription> sensors(const std::string& robot) const override;
  const sensing::SensorRegistry& sensor_types() const override { return *sensors_; }
  std::vector<Event> events(std::uint64_t first) const override;
  bool was_edited() const override;
  void AddObserver(std::shared_ptr<Observer> observer) override;
  void RemoveObserver(const std::shared_ptr<Observer>& observer) override;

 private:
  using AgentPtr = std::shared_ptr<RobotAgent>;
  using Lock = std::unique_lock<std::mutex>;

  // control.cc: what people and programs ask for.
  base::Status Go(SimTime until, std::int64_t steps);
  base::Status RefuseUnless(std::initializer_list<Phase> allowed, const char* action) const;
  void SetPhase(Phase phase);
  void StartAgents(const std::vector<AgentPtr>& agents);
  void EndAgents(std::string reason);
  void TellBehaviours(const char* what, base::Status (BehaviourPort::*call)());
  void ReportIfFailed(const AgentPtr& agent, const char* what, const base::Status& status);
  void AddEvent(std::string kind, std::string robot = {}, std::string detail = {},
                std::shared_ptr<const Edit> edit = nullptr);
  AgentPtr FindAgent(const std::string& robot) const;
  std::vector<AgentPtr> AgentsWithBehaviour() const;

  // population.cc: who stands in the world.
  base::Status PlaceRobots(std::vector<RobotSpecification>& robots);
  base::Status NameRobots(std::vector<RobotSpecification>& robots) const;
  // `pose`, lowered or lifted to where the model stands; `own`: its body, if it has one already.
  geometry::Pose StandingPose(const model::Model& model, geometry::Pose pose, int own = -1) const;
  // `placed`: bodies that are new, or put elsewhere, at their initial poses.
  base::Status ChangeLayout(std::vector<world::Body> bodies,
                            const std::vector<std::string>& placed);
  // The state of those who stay, and the start of those who come.
  world::State CarryOver(const world::Layout& layout) const;
  // Who stands where `body` does, or -1.
  int Intruded(const world::Layout& layout, const world::State& state, int body);
  // Refuses robots that would stand in others, or deep in walls.
  base::Status MakeRoom(const world::Layout& layout, const std::vector<std::string>& placed,
                        world::State& state);
  // Moves the body to the nearest free place, no farther than its own radius. False: none there.
  bool StepAside(const world::Layout& layout, int body, world::State& state);
  base::Status RemoveFromWorld(const std::vector<std::string>& names);
  void IndexAgents();
  base::Status CheckName(const std::string& name) const;

  // editing.cc: what people change by hand.
  // Waits for the end of the turns of behaviours elsewhere, if they are not taking long.
  void AwaitTurns();
  // Under world_mutex_, when it has been done: tells of it.
  void Tell(Edit edit, const char* event, const std::string& detail = {});
  base::Status CheckMayEdit() const;
  // The body of that name; -1 and why not when it is fixed, or not there.
  base::Result<int> FindLoose(const std::string& name) const;
  base::Result<world::Body> BodyOf(const ObjectSpecification& object) const;
  base::Result<std::string> NameOf(const ObjectSpecification& object,
                                   const model::Model& model) const;
  // Has the engine move the bodies of `layout`, with what is held in `state`.
  base::Status SetEngineLayout(const std::shared_ptr<const world::Layout>& layout,
                               const world::State& state);

  // watchdog.cc: who has died, and who never comes back.
  void KeepWatch();
  void LookForDeaths();
  void LookForEndlessTurns();
  // Empty when the simulation is stuck.
  std::unique_lock<std::timed_mutex> LockWorld() const;
  // Until no call to a behaviour is under way. Fails when one in process does not return.
  base::Status AwaitCalls();
  base::Status RefuseStuck() const;

  // faults.cc: what goes wrong because a scenario says so.
  base::Status CheckFaults() const;
  bool IsFaultDue() const;
  // All that are due, in order; on the stepping thread, between two steps.
  void ApplyFaults();
  base::Status Apply(const scenario::Fault& fault);
  base::Status MoveBody(const scenario::Fault& fault);
  base::Status MoveJoint(const scenario::Fault& fault);
  // Back to where faults found everything.
  base::Status UndoFaults();

  // step_loop.cc: the stepping thread.
  void RunLoop();
  void WakeAgents();
  // Local behaviours whose time has come run until they wait.
  void TakeTurns();
  void PostBlocked(AgentPtr agent, std::function<void()> work);
  void GiveUpOn(RobotAgent& agent);
  // True when every agent waits. Else it has waited for something to change.
  bool AllWait(Lock& lock);
  bool IsDue(Lock& lock);
  void TakeStep();
  void ApplyCommands();  // under both locks
  std::shared_ptr<const world::Snapshot> MoveWorld();
  void AfterStep(const std::shared_ptr<const world::Snapshot>& snapshot, WallTime start);
  void Finish();
  void Fail(std::string reason);
  std::string HashNow() const;  // under both locks

  const Specification specification_;
  const SimTime step_;
  const std::shared_ptr<const sensing::SensorRegistry> sensors_;
  const std::shared_ptr<SharedState> shared_;

  std::mutex control_mutex_;

  mutable std::timed_mutex world_mutex_;
  const std::shared_ptr<base::ThreadTeam> team_;  // works for whoever holds world_mutex_
  std::unique_ptr<dynamics::Engine> engine_;
  std::shared_ptr<const world::Layout> layout_;
  world::State state_;
  Attachments attachments_;
  // Since the last step; stepping thread only.
  DeviceActions device_actions_;
  std::vector<world::Transmission> transmissions_;
  SnapshotPool snapshots_;
  world::WheelOdometry wheel_odometry_;
  Turn::Instant instant_;           // of the turns being taken
  std::vector<RobotAgent*> turns_;  // being taken
  GateOpener gate_opener_;
  GateOpener::Gates woken_;  // of those who have just been woken; stepping thread only

  // In the order in which they happen; guarded by shared_->mutex.
  std::vector<scenario::Fault> faults_;
  std::size_t faults_done_ = 0;
  // Where static bodies stood that faults have moved; guarded by world_mutex_.
  std::map<std::string, geometry::Pose> stood_at_;
  // Objects that were taken away, the newest last; guarded by world_mutex_.
  std::deque<world::Body> removed_;

  // A turn is under way that has lasted longer than the deadline, with world_mutex_ held. Changes
  // under shared_->mutex.
  std::atomic<bool> is_stuck_{false};
  std::atomic<bool> has_hosted_{false};  // has had a behaviour in process

  // Guarded by shared_->mutex.
  std::map<std::string, AgentPtr> agents_;
  bool quit_ = false;
  mutable std::condition_variable phase_changed_;  // for those who watch
  std::condition_variable watch_;                  // wakes the watchdog to quit
  std::set<std::string> watched_now_;  // robots whose behaviour is being asked for a sign of life
  bool restart_pacing_ = false;
  int starts_pending_ = 0;
  SimTime run_until_{0};  // 0: none
  std::optional<SimTime> run_through_;
  bool turns_have_begun_ = false;  // those who wake at this instant were woken
  bool was_started_ = false, was_edited_ = false;
  std::int64_t steps_left_ = -1;   // -1: no limit
  std::uint64_t run_ = 0;          // grows whenever it is told to go
  std::uint64_t stepped_run_ = 0;  // in which the present step began
  std::string failure_;
  std::string final_hash_;  // of a run that finished
  Pacer pacer_;
  double factor_;  // of the pacer
  RunStatistics statistics_;

  mutable std::mutex events_mutex_;
  std::deque<Event> events_;
  std::uint64_t events_dropped_ = 0;
  std::vector<std::shared_ptr<Observer>> observers_;

  BehaviourCaller caller_;
  std::jthread stepping_;
  std::jthread watchdog_;
};

}  // namespace gsv::simulation
