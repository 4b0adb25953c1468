// The simulation's side of one behaviour: its clocks, its commands, its readings. What its hardware
// servants call; also how a viewer steers an avatar.
//
// Threads  any; SleepUntil() and Exchange() block, up to the lease they are given.
// Errors   kNotRunning: the agent waits (in lockstep nothing may come from it then). kEnded: the
//          simulation has stopped or is gone.
#pragma once

#include <chrono>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "gsv/base/error.h"
#include "gsv/base/sim_time.h"
#include "gsv/model/sensor_description.h"
#include "gsv/sensing/reading.h"
#include "gsv/world/snapshot.h"

namespace gsv::simulation {

using ClockId = int;

// A wait is a lease: it is answered `not yet` when the lease ends first, and is then to be repeated
// with the same arguments. The agent stays waiting in between.
enum class Wait { kReached, kNotYet };

struct NamedReading {
  std::string sensor;
  sensing::Reading reading;
};

struct Exchanged {
  Wait wait = Wait::kNotYet;
  base::SimTime now{0};
  std::vector<NamedReading> readings;  // kReached: of all opened sensors, by name
};

struct JointReading {
  base::SimTime time{0};
  double position = 0;  // rad or m
  double velocity = 0;  // rad/s or m/s
};

// `joint` counts the joints of the body's model.
inline JointReading JointReadingIn(const world::Snapshot& snapshot, int body, int joint) {
  const auto index = static_cast<std::size_t>(
      snapshot.layout->bodies[static_cast<std::size_t>(body)].first_joint + joint);
  const world::State& state = snapshot.state;
  return {state.time, state.joint_positions[index], state.joint_velocities[index]};
}

class MountedSensor;

class Agent {
 public:
  virtual ~Agent() = default;

  virtual const std::string& robot() const = 0;
  virtual std::string model() const = 0;
  virtual double footprint_radius() const = 0;  // m
  // A link of the robot's model, joints at zero; `link` is one of its sensors'.
  virtual geometry::Pose RobotFromLink(int link) const = 0;

  // Clocks. The behaviour runs while any of its clocks does; when all are closed it has finished.
  virtual base::Result<ClockId> OpenClock() = 0;
  virtual base::Status CloseClock(ClockId clock) = 0;
  // Instead: the behaviour's run has ended with an error. The agent is dead from this instant on,
  // and `reason` is told, on one line and cut off where it is long.
  virtual base::Status GiveUp(ClockId clock, const std::string& reason) = 0;
  virtual base::SimTime Now() const = 0;
  virtual base::Result<Wait> SleepUntil(ClockId clock, base::SimTime until,
                                        std::chrono::milliseconds lease) = 0;
  // Commands now, then waits, then reads. `cycle` counts the exchanges of this clock from 1; a
  // repetition carries the same number and commands nothing. `command` empty: as before.
  virtual base::Result<Exchanged> Exchange(ClockId clock, std::uint64_t cycle,
                                           std::optional<world::DriveCommand> command,
                                           base::SimTime until,
                                           std::chrono::milliseconds lease) = 0;

  virtual base::Status Command(const world::DriveCommand& command) = 0;

  // Joints, by their index in the robot's model. A command acts from this instant until the next;
  // efforts are refused where forces do not move the robot.
  virtual const std::vector<model::Joint>& Joints() const = 0;
  virtual base::Status CommandJoint(int joint, const world::JointCommand& command) = 0;
  virtual base::Result<JointReading> ReadJoint(int joint) = 0;

  // Sensors: those of the model, opened by name, and further ones.
  virtual std::vector<model::SensorDescription> Sensors() const = 0;
  virtual std::vector<std::string> SensorTypes() const = 0;
  virtual base::Status OpenSensor(const std::string& name) = 0;
  virtual base::Status CreateSensor(model::SensorDescription description) = 0;
  virtual base::Status CloseSensor(const std::string& name) = 0;
  virtual base::Result<sensing::Reading> Read(const std::string& sensor) = 0;
  // By a radio, to the robot `receiver`; empty: to all. Goes out at this instant, and is heard with
  // the next step.
  virtual base::Status Send(const std::string& radio, const std::string& receiver,
                            std::string content) = 0;
  // Commands an actuator, of the sensors, from this instant on.
  virtual base::Status CommandDevice(const std::string& actuator, world::DeviceCommand command) = 0;
  // For the turns of a local behaviour.
  virtual base::Result<std::shared_ptr<MountedSensor>> Mounted(const std::string& sensor) const = 0;
};

}  // namespace gsv::simulation
