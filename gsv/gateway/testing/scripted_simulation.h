// For tests: a simulation whose robots drive in circles by a formula, so that all values are known
// in closed form. It has GSV's own sensors. Bodies move only with Advance().
//
// World    "arena": a floor, four crates at (±4, ±4), robots robot_0, robot_1, … and one avatar.
//          Robot i drives around (0, 0) with radius 1 + i/2 at 0.2 rad/s, with a phase of i
//          radians. Its wheels turn at 1 rad/s.
// Threads  any.
#pragma once

#include <condition_variable>
#include <functional>
#include <mutex>

#include "gsv/simulation/simulation.h"

namespace gsv::gateway::testing {

class ScriptedSimulation final : public simulation::Simulation {
 public:
  ScriptedSimulation(std::string name, int robots);

  // Advances time, in any phase.
  void Advance(base::SimTime time);
  // Returns the command of robot i.
  static world::DriveCommand CommandOf(int robot);
  // Sets a robot's drive command in the latest and later snapshots.
  void SetDriveState(const std::string& robot, const world::DriveCommand& command,
                     base::SimTime time);
  // Advances by one step, in which a contact of the two bodies begins at the origin of the first
  // body.
  void Meet(const std::string& first, const std::string& second);
  // Passes the times of a step to the observers that request them.
  void Time(const simulation::StepTimes& times);
  // The number of observers that were added.
  std::size_t observers() const;
  // Adds a robot at the end; the layout changes.
  void AddOneRobot();
  // Adds a sensor to a robot; the layout does not change.
  void Mount(const std::string& robot, model::SensorDescription sensor);
  void AddEvent(const std::string& kind);
  // Sets a function that Watch() calls first.
  void set_on_watch(std::function<base::Status(const std::string& sensor)> on_watch);
  world::DriveCommand avatar_command() const;
  // Returns the joint that was commanded last, and its command.
  std::pair<int, world::JointCommand> joint_command() const;

  // The functions from AddRobots() to CommandJoint() always return kInvalidArgument, because this
  // simulation does not support these changes.
  base::Result<std::vector<std::string>> AddRobots(
      std::vector<simulation::RobotSpecification> robots) override;
  base::Status RemoveRobot(const std::string& name) override;
  base::Result<std::string> AddObject(simulation::ObjectSpecification object) override;
  base::Status RemoveObject(const std::string& name) override;
  base::Status PlaceBody(const std::string& name, const geometry::Pose& world_from_body,
                         bool on_ground) override;
  base::Status SetBehaviour(const std::string& robot,
                            std::shared_ptr<simulation::BehaviourPort> behaviour) override;
  base::Status CommandJoint(const std::string& body, const std::string& joint,
                            const world::JointCommand& command) override;

  bool was_edited() const override { return false; }
  base::Status Start() override;
  base::Status Pause() override;
  base::Status Resume() override;
  base::Status Step(std::int64_t count) override;
  base::Status RunUntil(base::SimTime until) override;
  base::Status RunThrough(base::SimTime until) override;
  base::Status Stop() override;
  base::Status Reset() override;
  base::Status SetRealTimeFactor(double factor) override;
  base::Status SetGravity(std::optional<double> z) override;
  std::optional<double> gravity() const;  // The gravity that was last set.
  double real_time_factor() const override;
  const simulation::Specification& specification() const override { return specification_; }
  simulation::SimulationStatus status() const override;
  std::shared_ptr<const world::Snapshot> snapshot() const override;
  std::string state_hash() const override;
  simulation::Phase WaitForPhase(const std::vector<simulation::Phase>& phases,
                                 std::chrono::milliseconds timeout) const override;
  std::shared_ptr<simulation::Agent> agent(const std::string& robot) const override;
  base::Result<sensing::Reading> Watch(const std::string& robot,
                                       const std::string& sensor) override;
  std::vector<model::SensorDescription> sensors(const std::string& robot) const override;
  std::uint64_t sensor_changes() const override;
  const sensing::SensorRegistry& sensor_types() const override { return sensor_types_; }
  std::vector<simulation::Event> events(std::uint64_t first) const override;
  std::vector<simulation::Event> outputs(std::uint64_t first) const override;
  void Emit(std::string_view kind, const std::string& robot, const std::string& detail) override;
  void SetExpectations(std::weak_ptr<const simulation::ExpectationSource> source) override;
  std::vector<simulation::ExpectationState> expectations() const override;
  // Sets the motion of a robot in status().
  void SetMotion(const std::string& robot, const simulation::Motion& motion);
  void AddObserver(std::shared_ptr<simulation::Observer> observer) override;
  void RemoveObserver(const std::shared_ptr<simulation::Observer>& observer) override;

 private:
  class Avatar;

  void PlaceAll();  // makes the layout, and places all bodies at time_
  void PublishSnapshot();
  base::Status ChangePhase(simulation::Phase phase, std::vector<simulation::Phase> from,
                           const char* event);

  simulation::Specification specification_;
  sensing::SensorRegistry sensor_types_;
  sensing::RaySceneCache rays_;
  std::shared_ptr<const model::Model> floor_, crate_, robot_model_;
  std::shared_ptr<Avatar> avatar_;

  mutable std::mutex mutex_;
  mutable std::condition_variable changed_;  // notified after changes of phase_
  int robots_ = 0;                           // number of robots
  simulation::Phase phase_ = simulation::Phase::kCreated;
  base::SimTime time_{0};
  std::shared_ptr<const world::Layout> layout_;
  std::shared_ptr<const world::Snapshot> snapshot_;
  std::vector<simulation::Event> events_, outputs_;
  std::weak_ptr<const simulation::ExpectationSource> expectations_;
  std::map<std::string, simulation::Motion> motions_;  // by robot
  // Sensors that Mount() has added, by robot.
  std::map<std::string, std::vector<model::SensorDescription>> mounted_;
  std::map<std::string, world::DriveState> drive_states_;  // by robot
  std::function<base::Status(const std::string&)> on_watch_;
  std::vector<std::shared_ptr<simulation::Observer>> observers_;
  double factor_ = 1;
  std::optional<double> gravity_;
};

}  // namespace gsv::gateway::testing
