// Implements the class Robot (sdk/behaviour/robot.h) for a behaviour that runs in this process.
//
// Threads  only the thread that executes the behaviour's turn.
#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "gsv/hosting/sweep_plan.h"
#include "gsv/simulation/robots/local_behaviour.h"
#include "sdk/behaviour/robot.h"

namespace gsv::hosting {

class alignas(64) LocalRobot final : public Robot {
 public:
  // The function that suspends the behaviour until its next turn: it returns from the current turn
  // to the simulation.
  using Suspend = std::function<void()>;

  explicit LocalRobot(std::shared_ptr<simulation::Agent> agent) : agent_(std::move(agent)) {}

  // Sets the current turn, or null between turns.
  void SetTurn(simulation::Turn* turn);
  // Must be called before a sensor that takes long is read in a turn.
  void SetSuspend(Suspend suspend) { suspend_ = std::move(suspend); }
  // Returns the address of the robot's count of sweeps, for prefetching. A sweep reads the beams of
  // all open sensors together, once per turn. Returns null if there are no sensors.
  const void* sweeps() const { return sweeps_.get(); }
  // Ends the run for the behaviour. From now on, waits and calls return at once.
  void End() { is_running_ = false; }
  // Ends the run for the behaviour because of this error, which error() then returns. An error
  // kEnded also ends the run, but error() does not return it.
  void Note(const base::Error& error);

  // Whether all open sensors can be read quickly. A camera, for example, takes long.
  bool HasOnlyFastSensors() const;
  // Reads all open sensors, ordered by name. The readings are valid until the next call on this
  // thread.
  const std::vector<Reading>& ReadOpenSensors();

  // The members of Robot.
  const std::string& name() const override { return agent_->robot(); }
  double footprint_radius() const override { return agent_->footprint_radius(); }
  std::vector<SensorTraits> Sensors() override;
  std::vector<JointTraits> Joints() override;
  base::Result<std::unique_ptr<Joint>> OpenJoint(const std::string& joint) override;
  void Command(const DriveCommand& command) override;
  SimTime Now() override;
  bool SleepUntil(SimTime instant) override;
  bool Exchange(const DriveCommand& command, SimTime instant,
                std::vector<Reading>& readings) override;
  bool IsRunning() const override { return is_running_; }
  std::string error() const override { return error_; }

  // Reads a sensor. Returns nullopt if the run is over. A sensor that fails ends the run.
  std::optional<sensing::Reading> Read(simulation::MountedSensor& sensor);

  // Sends a message. kInvalidArgument is returned to the caller; any other failure ends the run.
  base::Status Send(const simulation::MountedSensor& radio, const std::string& receiver,
                    const std::string& content);

  base::Status CommandDevice(const simulation::MountedSensor& actuator,
                             world::DeviceCommand command);

  // Command or read a joint, by its index in the model. Both functions do nothing after the end of
  // the run. A refused command ends the run.
  void CommandJoint(int joint, const world::JointCommand& command);
  std::optional<simulation::JointReading> ReadJoint(int joint);

 private:
  using SensorPtr = std::shared_ptr<simulation::MountedSensor>;

  // OpenPort() opens a sensor of the robot's model. CreatePort() adds a new sensor and opens it.
  base::Result<std::unique_ptr<SensorPort>> OpenPort(const std::string& sensor) override;
  base::Result<std::unique_ptr<SensorPort>> CreatePort(SensorTraits traits) override;
  // Adds the sensor to open_.
  base::Result<std::unique_ptr<SensorPort>> Enter(const std::string& sensor);
  // Reads a sensor that takes long, such as a camera. Suspends the behaviour until the reading is
  // available.
  base::Result<sensing::Reading> ReadBlocked(const simulation::MountedSensor& sensor);

  // Makes plan_ and sweeps_ for the present open sensors.
  void PlanSweeps();
  // Reads the beams of all open sensors together. Reads nothing and returns false if there is no
  // current turn, if the simulation does not allow sweeps, or if there are fewer than kMinSweep
  // beams. `readings` must have the names of the sensors.
  bool SweepInto(std::vector<Reading>& readings);
  // Reads all open sensors: their beams together if possible, the others one by one.
  void ReadInto(std::vector<Reading>& readings);

  // The members that each turn of a controller uses come first, in one cache line.
  simulation::Turn* turn_ = nullptr;            // the present turn; null between turns
  std::size_t ray_sensors_ = 0;                 // how many open sensors cast rays
  std::shared_ptr<const SweepPlan> plan_;       // the plan for open_; null without sensors
  std::shared_ptr<simulation::Sweeps> sweeps_;  // see sweeps()
  bool is_plan_shared_ = false;                 // whether plan_ is a result of Share()
  std::atomic<bool> is_running_{true};

  const std::shared_ptr<simulation::Agent> agent_;  // the robot in the simulation
  Suspend suspend_;              // suspends the behaviour; empty before SetSuspend()
  std::vector<SensorPtr> open_;  // ordered by name
  std::string error_;            // reason for the end of the run; empty if there is none
};

}  // namespace gsv::hosting
