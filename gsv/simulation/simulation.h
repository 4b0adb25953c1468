// A simulation: a world, its robots and their agents, a clock, and the loop that steps it.
//
// Threads      every public member may be called from any thread. A member blocks for at most one
//              step, unless its comment says otherwise.
// Determinism  in lockstep the state after each step is a function of the specification, the robots
//              and the commands of their behaviours; see "Time" in ARCHITECTURE.md.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "gsv/base/error.h"
#include "gsv/sensing/registry.h"
#include "gsv/simulation/agent.h"
#include "gsv/simulation/behaviour_port.h"
#include "gsv/simulation/observer.h"
#include "gsv/simulation/types.h"
#include "gsv/world/snapshot.h"

namespace gsv::simulation {

// A robot that is added to the world.
struct RobotSpecification {
  std::string name;  // if empty: the model's name, with a number if this name is taken
  std::shared_ptr<const model::Model> model;
  geometry::Pose world_from_robot;
  // Whether the robot is moved vertically so that it stands on the floor, see sensing/ground.h.
  bool on_ground = true;
  std::shared_ptr<BehaviourPort> behaviour;  // if null, the robot does not move
  // Whether a behaviour may use the wall clock in lockstep.
  bool allow_unmanaged = false;
  bool is_avatar = false;
  std::optional<model::Movement> movement;  // if not set, the movement of the model
  // A text as in model/drive_choice.h. If empty: the model's own drive, or a guessed drive if the
  // model has none.
  std::string drive;
};

// An object (not a robot) that is added to the world.
struct ObjectSpecification {
  std::string name;  // if empty: the model's name, with a number if this name is taken
  std::shared_ptr<const model::Model> model;  // if null, the model of `copy_of`
  // The name of the body to copy: a body of the simulation or of the world file, or an object that
  // a user removed.
  std::string copy_of;
  geometry::Pose world_from_object;
  // Whether the object is moved vertically so that it stands on the floor, see sensing/ground.h.
  bool on_ground = true;
};

// Judges the expectations of a scenario while the simulation runs.
//
// Threads  any.
class ExpectationSource {
 public:
  virtual ~ExpectationSource() = default;
  // The state of each expectation at the latest evaluated step, in the order of the scenario.
  virtual std::vector<ExpectationState> states() const = 0;
};

// The interface of a simulation.
class Simulation : public std::enable_shared_from_this<Simulation> {
 public:
  // Creates a simulation. `sensors` must outlive it. Fails if the specification or the world is
  // invalid.
  static base::Result<std::shared_ptr<Simulation>> Create(
      Specification specification, std::shared_ptr<const sensing::SensorRegistry> sensors);

  // Stops the simulation, and waits for the stepping thread and for calls to behaviours. If a
  // behaviour in this process does not return within the deadline, the simulation and its threads
  // are abandoned.
  virtual ~Simulation() = default;
  // The number of abandoned simulations. If it is above 0, the process must exit without calling
  // the destructors of static objects.
  static int AbandonedSimulations();

  // Adds a robot and initialises its behaviour; blocks until the behaviour answers. A robot that
  // would overlap a wall is placed beside the wall, with an event "robot_moved". Returns the
  // robot's name. Fails if the place or the name is taken, or if the behaviour fails in init.
  base::Result<std::string> AddRobot(RobotSpecification robot);
  // Adds many robots at once: all of them, or none in case of an error. See AddRobot().
  virtual base::Result<std::vector<std::string>> AddRobots(
      std::vector<RobotSpecification> robots) = 0;
  // Removes a robot. Fails for stations (objects with sensors), which RemoveObject() removes.
  virtual base::Status RemoveRobot(const std::string& name) = 0;
  // Adds an object at rest, while the simulation is created or paused. Returns its name. Fails if
  // the place or the name is taken, or if the model has a drive.
  virtual base::Result<std::string> AddObject(ObjectSpecification object) = 0;
  // Removes an object, while the simulation is created or paused. Static bodies of the world file
  // cannot be removed.
  virtual base::Status RemoveObject(const std::string& name) = 0;
  // Moves a body (a robot, an avatar or an object) to a pose, at rest, while the simulation is
  // created or paused. `on_ground` is explained at RobotSpecification. Before the first step, the
  // pose becomes the initial pose, also for later resets. The odometry does not change. Fails if
  // the place is taken, and for static bodies of the world file.
  virtual base::Status PlaceBody(const std::string& name, const geometry::Pose& world_from_body,
                                 bool on_ground) = 0;
  // Gives a behaviour to a robot that has none, such as a robot of the world file.
  virtual base::Status SetBehaviour(const std::string& robot,
                                    std::shared_ptr<BehaviourPort> behaviour) = 0;

  // Commands a joint of a rigid body or of a robot from the next step on. Fails if there is no such
  // joint, or if world::CheckJointCommand() fails. For reproducible runs, call it while the
  // simulation is paused.
  virtual base::Status CommandJoint(const std::string& body, const std::string& joint,
                                    const world::JointCommand& command) = 0;

  // Sets the gravity along the world's z in m/s² (negative is downwards) from the next step on.
  // nullopt restores the world's own gravity. Allowed while the simulation is created or paused; a
  // reset keeps it. It has no effect on bodies with planar kinematics.
  virtual base::Status SetGravity(std::optional<double> z) = 0;

  // Requests. A request returns when it is accepted; status() shows the result. If the phase does
  // not allow a request, it fails with kNotRunning and lists the allowed phases.
  virtual base::Status Start() = 0;
  virtual base::Status Pause() = 0;
  virtual base::Status Resume() = 0;
  // Takes `count` steps and then pauses. Allowed while the simulation is paused or created.
  virtual base::Status Step(std::int64_t count) = 0;
  // Runs until the simulated time `until` and then pauses. No agent is woken at that instant.
  virtual base::Status RunUntil(SimTime until) = 0;
  // Runs until `until`, which may be the current time. Agents whose waits end at that instant have
  // their turns. Then the simulation pauses, before the next step. Allowed while the simulation is
  // paused or created.
  virtual base::Status RunThrough(SimTime until) = 0;
  virtual base::Status Stop() = 0;
  // Resets bodies, time and behaviours. It blocks until the behaviours have answered.
  virtual base::Status Reset() = 0;

  // Sets the target real-time factor from the next step on, in (0, 1e6]. A reset keeps it. Refused
  // in lockstep. Returns at once.
  virtual base::Status SetRealTimeFactor(double factor) = 0;
  virtual double real_time_factor() const = 0;

  virtual const Specification& specification() const = 0;
  virtual SimulationStatus status() const = 0;
  // Returns the latest snapshot, never null.
  virtual std::shared_ptr<const world::Snapshot> snapshot() const = 0;
  // The hash of the latest snapshot and of the instants that agents wait for. Empty if a behaviour
  // in this process exceeds its deadline, see local_behaviour.h.
  virtual std::string state_hash() const = 0;

  // Blocks until the phase is one of `phases`, but at most for `timeout` of wall-clock time.
  // Returns the phase.
  virtual Phase WaitForPhase(const std::vector<Phase>& phases,
                             std::chrono::milliseconds timeout) const = 0;

  // Returns the agent of a robot, an avatar or a station (world/station.h), or null if the name is
  // unknown.
  virtual std::shared_ptr<Agent> agent(const std::string& robot) const = 0;

  // Returns a sensor's reading at the latest snapshot, for an observer. The robot's behaviour would
  // get an equal reading. The call does not change the simulation. It may be slow, for example for
  // an image. If the stepping thread makes the call, as in Observer::OnSnapshot(), the next step is
  // delayed.
  virtual base::Result<sensing::Reading> Watch(const std::string& robot,
                                               const std::string& sensor) = 0;
  // Returns the sensors of a robot: those of its model, and those that were created.
  virtual std::vector<model::SensorDescription> sensors(const std::string& robot) const = 0;
  // Returns the number of sensors that were created or removed so far, on all robots. While this
  // number and the layout stay the same, sensors() returns the same lists.
  virtual std::uint64_t sensor_changes() const = 0;
  virtual const sensing::SensorRegistry& sensor_types() const = 0;

  // Returns the events from number `first` on, counted from 0. Only a limited number of events is
  // kept; the oldest events are dropped.
  virtual std::vector<Event> events(std::uint64_t first) const = 0;
  // Returns the lines that the behaviours' programs printed, from line number `first` on. Lines and
  // events are numbered separately.
  virtual std::vector<Event> outputs(std::uint64_t first) const = 0;
  // Emits an event at the current step. Must not be called from Observer::OnEvent().
  virtual void Emit(std::string_view kind, const std::string& robot, const std::string& detail) = 0;

  // Sets the source of the states that expectations() returns. The source may be destroyed before
  // the simulation.
  virtual void SetExpectations(std::weak_ptr<const ExpectationSource> source) = 0;
  // Returns the states of the expectations; empty if there are none.
  virtual std::vector<ExpectationState> expectations() const = 0;

  // Whether a body was added, removed or moved after the first start, or the gravity was set.
  virtual bool was_edited() const = 0;

  // Adds an observer, which is notified from the next step on. The simulation keeps it alive until
  // it is removed or the simulation ends.
  virtual void AddObserver(std::shared_ptr<Observer> observer) = 0;
  virtual void RemoveObserver(const std::shared_ptr<Observer>& observer) = 0;
};

}  // namespace gsv::simulation
