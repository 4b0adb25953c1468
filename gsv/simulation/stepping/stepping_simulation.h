// Implements Simulation. The class connects the parts that own the data, and passes requests to
// them.
//
//   RunControl, LifeCycle   the phase, and the actions on its changes
//   AgentPopulation         the robots' agents and behaviours
//   SimulatedWorld          layout, state, engine; changed by WorldEditor and FaultInjector
//   EventLog                events and observers
//   StepLoop, Watchdog      a thread each
//
// Locks, in the order in which they are taken: control_mutex_ (one request at a time),
// SimulatedWorld::lock(), SharedState::mutex (life cycle, agents, faults that are due), the lock of
// EventLog. During a call to a behaviour, only control_mutex_ may be locked. During the turn of a
// behaviour in this process, the world's lock is locked as well.
#pragma once

#include "gsv/base/thread_team.h"
#include "gsv/simulation/editing/robot_models.h"
#include "gsv/simulation/stepping/step_loop.h"
#include "gsv/simulation/stepping/watchdog.h"

namespace gsv::simulation {

// The implementation of Simulation.
class SteppingSimulation final : public Simulation {
 public:
  SteppingSimulation(Specification specification,
                     std::shared_ptr<const sensing::SensorRegistry> sensors,
                     std::shared_ptr<base::ThreadTeam> team,
                     std::unique_ptr<dynamics::Engine> engine,
                     std::shared_ptr<const world::Layout> layout);
  ~SteppingSimulation() override;
  // Destroys the simulation, or abandons it if a behaviour in this process does not return.
  static void Dispose(SteppingSimulation* simulation);

  // Implemented in editing.cc.
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
  base::Status SetGravity(std::optional<double> z) override;
  bool was_edited() const override;

  // Implemented in control.cc.
  base::Status Start() override;
  base::Status Pause() override;
  base::Status Resume() override;
  base::Status Step(std::int64_t count) override;
  base::Status RunUntil(SimTime until) override;
  base::Status RunThrough(SimTime until) override;
  base::Status Stop() override;
  base::Status Reset() override;
  base::Status SetRealTimeFactor(double factor) override;
  double real_time_factor() const override;
  Phase WaitForPhase(const std::vector<Phase>& phases,
                     std::chrono::milliseconds timeout) const override;

  // Implemented in stepping_simulation.cc.
  const Specification& specification() const override { return specification_; }
  SimulationStatus status() const override;
  std::shared_ptr<const world::Snapshot> snapshot() const override;
  std::string state_hash() const override;
  std::shared_ptr<Agent> agent(const std::string& robot) const override;
  base::Result<sensing::Reading> Watch(const std::string& robot,
                                       const std::string& sensor) override;
  std::vector<model::SensorDescription> sensors(const std::string& robot) const override;
  std::uint64_t sensor_changes() const override;
  const sensing::SensorRegistry& sensor_types() const override { return *sensors_; }
  std::vector<Event> events(std::uint64_t first) const override { return events_.Since(first); }
  std::vector<Event> outputs(std::uint64_t first) const override {
    return events_.OutputsSince(first);
  }
  void Emit(std::string_view kind, const std::string& robot, const std::string& detail) override {
    events_.Emit(std::string(kind), robot, detail);
  }
  void SetExpectations(std::weak_ptr<const ExpectationSource> source) override;
  std::vector<ExpectationState> expectations() const override;
  void AddObserver(std::shared_ptr<Observer> observer) override;
  void RemoveObserver(const std::shared_ptr<Observer>& observer) override;

 private:
  // Returns the agent, or null if the name is unknown.
  AgentPopulation::AgentPtr FindAgent(const std::string& robot) const;
  // Returns the agent, or an error that names the robot.
  base::Result<AgentPopulation::AgentPtr> RequireAgent(const std::string& robot) const;
  // Returns the error of a stuck simulation, see world_lock.h.
  base::Status RefuseStuck() const;

  // Calls `request` with run_, with the locks held. `request` returns a Result<RunControl::Change>.
  template <typename Request>
  base::Status Perform(Request request);
  // Waits until no call to a behaviour is in progress. Fails if a behaviour in this process does
  // not return.
  base::Status AwaitCalls();

  // Waits a short time until behaviours in other processes have ended their turns.
  void AwaitTurns() const;
  // Fails if the simulation is stuck, or if its phase allows no edits.
  base::Status CheckMayEdit(const WorldGuard& guard) const;
  // Updates the index of each agent's body after a change of the layout.
  void AssignBodies() GSV_REQUIRES(world_mutex);
  // Emits the event of an edit.
  void RecordEdit(Edit edit, const char* event, const std::string& detail = {})
      GSV_REQUIRES(world_mutex);
  // Creates the agent of an object with sensors.
  void AddStation(const std::string& name) GSV_REQUIRES(world_mutex);
  // Adds the robots to the world, and creates their agents.
  base::Status PlaceRobots(std::vector<RobotSpecification>& robots);
  // Removes robots and their agents, for example after a failed init.
  base::Status RemoveRobots(const std::vector<std::string>& names);

  const Specification specification_;
  const std::shared_ptr<const sensing::SensorRegistry> sensors_;
  const std::shared_ptr<SharedState> shared_;  // state shared by the parts below
  SimulatedWorld world_;
  EventLog events_;
  BehaviourCaller caller_;
  AgentPopulation agents_;
  LifeCycle life_cycle_;
  RunControl& run_ GSV_GUARDED_BY(simulation_mutex);  // the phase of the run; part of life_cycle_
  WorldEditor editor_;
  FaultInjector faults_;
  StepLoop step_loop_;
  Watchdog watchdog_;
  base::Mutex control_mutex_;  // held during a request, so that requests do not overlap
  // Models of the robots, with their drives.
  RobotModels robot_models_ GSV_GUARDED_BY(control_mutex_);
  mutable base::Mutex expectations_mutex_;
  std::weak_ptr<const ExpectationSource> expectations_ GSV_GUARDED_BY(expectations_mutex_);
};

}  // namespace gsv::simulation
