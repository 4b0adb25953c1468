// One simulation: a world, its robots and their agents, a clock, and the loop that steps it.
//
// Threads      every public member may be called from any thread; none blocks on the stepping
//              thread for longer than a step, except where it says so.
// Determinism  in lockstep the state after each step is a function of the specification, the robots
//              and what their behaviours command; see docs of time in ARCHITECTURE.md.
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

struct RobotSpecification {
  std::string name;  // empty: the model's name, numbered if taken
  std::shared_ptr<const model::Model> model;
  geometry::Pose world_from_robot;
  // Lowered or lifted onto the floor at its place, see sensing/ground.h.
  bool on_ground = true;
  std::shared_ptr<BehaviourPort> behaviour;  // may be null: the robot stands still
  // A behaviour that tells the time by the wall clock takes part in lockstep all the same.
  bool allow_unmanaged = false;
  bool is_avatar = false;
  std::optional<model::Movement> movement;  // without one, as its model says
  // As model/drive_choice.h has it; empty: the model's own drive, else the guessed one.
  std::string drive;
};

// Something that is no robot, to be put into the world.
struct ObjectSpecification {
  std::string name;                           // empty: the model's name, numbered if taken
  std::shared_ptr<const model::Model> model;  // null: the model of `copy_of`
  // A body that stands here, came with the world, or was removed by hand.
  std::string copy_of;
  geometry::Pose world_from_object;
  // Lowered or lifted onto the floor at its place, see sensing/ground.h.
  bool on_ground = true;
};

class Simulation : public std::enable_shared_from_this<Simulation> {
 public:
  // `sensors` outlives the simulation. Fails when the specification or the world cannot be run.
  static base::Result<std::shared_ptr<Simulation>> Create(
      Specification specification, std::shared_ptr<const sensing::SensorRegistry> sensors);

  // Stops, waits for the stepping thread and for calls to behaviours. A simulation in which a
  // behaviour in process does not return within the deadline is left to itself, with its threads.
  virtual ~Simulation() = default;
  // How many were; with such threads about a process must end without destroying what they use.
  static int AbandonedSimulations();

  // Places a robot (beside a wall that it would touch, with an event "robot_moved") and initialises
  // its behaviour (blocks while that answers). Gives the name under which it stands. Fails when the
  // place is taken, the name is, or the behaviour fails in init.
  base::Result<std::string> AddRobot(RobotSpecification robot);
  // The same for many at once: all stand, or none does.
  virtual base::Result<std::vector<std::string>> AddRobots(
      std::vector<RobotSpecification> robots) = 0;
  // Fails for stations, which are objects.
  virtual base::Status RemoveRobot(const std::string& name) = 0;
  // Puts a thing that is no robot into the world, at rest, while the simulation is created or
  // paused, and gives the name under which it stands. Fails when the place or the name is taken, or
  // the model has a drive.
  virtual base::Result<std::string> AddObject(ObjectSpecification object) = 0;
  // Takes one away, while the simulation is created or paused. What came with the world and is
  // fixed to it stays.
  virtual base::Status RemoveObject(const std::string& name) = 0;
  // Puts a body (a robot, an avatar, an object) elsewhere, at rest, while the simulation is created
  // or paused; `on_ground` as for robots. Before the first step that is where it starts, also after
  // a reset. What its wheels have measured and its behaviour believes stays as it was. Fails when
  // the place is taken, and for what came with the world and is fixed to it.
  virtual base::Status PlaceBody(const std::string& name, const geometry::Pose& world_from_body,
                                 bool on_ground) = 0;
  // Gives a behaviour to a robot that has none, such as one that came with the world.
  virtual base::Status SetBehaviour(const std::string& robot,
                                    std::shared_ptr<BehaviourPort> behaviour) = 0;

  // Tells a joint of a rigid body what to do, from the next step on; what it does is seen in the
  // snapshot. Fails when there is no such joint, or forces do not move it. In a run that is to be
  // repeated it is given while the simulation is paused.
  virtual base::Status CommandJoint(const std::string& body, const std::string& joint,
                                    const world::JointCommand& command) = 0;

  // Gravity along the world's z, in m/s² (negative: downwards), from the next step on; without `z`
  // the world's own. While the simulation is created or paused; it outlives a reset. Bodies that
  // planar kinematics moves do not feel it.
  virtual base::Status SetGravity(std::optional<double> z) = 0;

  // Each returns once the request is accepted; what comes of it is seen in status(). An action that
  // the phase does not allow fails with kNotRunning and says what is allowed.
  virtual base::Status Start() = 0;
  virtual base::Status Pause() = 0;
  virtual base::Status Resume() = 0;
  // Paused (or created): takes `count` steps, then is paused again.
  virtual base::Status Step(std::int64_t count) = 0;
  // Runs until the simulated time `until`, then freezes: nobody is woken at that instant.
  virtual base::Status RunUntil(SimTime until) = 0;
  // The same from a pause or the start, but those whose waits end at that instant, which may be
  // now, have their turn: it freezes when a step would be taken.
  virtual base::Status RunThrough(SimTime until) = 0;
  virtual base::Status Stop() = 0;
  // Back to the start: bodies, time, behaviours (initialised anew). Blocks while these answer.
  virtual base::Status Reset() = 0;

  // In real time: how many simulated seconds pass in a wall second, from the next step on; above 0,
  // at most 1e6. It outlives a reset. Lockstep has no factor and refuses. Returns at once.
  virtual base::Status SetRealTimeFactor(double factor) = 0;
  virtual double real_time_factor() const = 0;

  virtual const Specification& specification() const = 0;
  virtual SimulationStatus status() const = 0;
  virtual std::shared_ptr<const world::Snapshot> snapshot() const = 0;  // the latest; never null
  // Of the latest snapshot and the agents' waits; empty when a behaviour in process holds the world
  // for longer than the deadline, see local_behaviour.h.
  virtual std::string state_hash() const = 0;

  // Blocks until the phase is one of `phases` or `timeout` of wall time has passed; gives the
  // phase.
  virtual Phase WaitForPhase(const std::vector<Phase>& phases,
                             std::chrono::milliseconds timeout) const = 0;

  // The agent of a robot, an avatar or a station (world/station.h); null if there is none of that
  // name.
  virtual std::shared_ptr<Agent> agent(const std::string& robot) const = 0;

  // A reading for a viewer: the one that the robot's own behaviour gets at that snapshot. It leaves
  // no trace. May take long (an image): on the stepping thread, as in Observer::OnSnapshot(), it
  // delays the next step by as much.
  virtual base::Result<sensing::Reading> Watch(const std::string& robot,
                                               const std::string& sensor) = 0;
  // The sensors of a robot: those of its model and those that were mounted since.
  virtual std::vector<model::SensorDescription> sensors(const std::string& robot) const = 0;
  virtual const sensing::SensorRegistry& sensor_types() const = 0;

  // Events from number `first` on, counted from 0 (bounded: the oldest are dropped).
  virtual std::vector<Event> events(std::uint64_t first) const = 0;

  // Whether anybody was added, removed or placed since it was first started.
  virtual bool was_edited() const = 0;

  // From the next step on; kept alive until removed or the simulation ends.
  virtual void AddObserver(std::shared_ptr<Observer> observer) = 0;
  virtual void RemoveObserver(const std::shared_ptr<Observer>& observer) = 0;
};

}  // namespace gsv::simulation
