// An agent is the interface through which the behaviour of one robot uses the simulation: clocks,
// commands and readings. The CORBA servants of the robot's hardware call it, and viewers steer
// avatars with it.
//
// Threads  any; SleepUntil(), Exchange() and SleepAndRead() wait for at most the given lease.
// Errors   kNotRunning: in lockstep, a behaviour may command and read only while it runs, and this
//          one waits for its clocks. kEnded: the simulation has stopped or was destroyed.
#pragma once

#include <chrono>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "gsv/base/error.h"
#include "gsv/base/sim_time.h"
#include "gsv/exchange/shared_file.h"
#include "gsv/model/sensor_description.h"
#include "gsv/sensing/reading.h"
#include "gsv/world/snapshot.h"

namespace gsv::simulation {

// Identifies an open clock of one agent. OpenClock() returns it.
using ClockId = int;

// The result of a wait for an instant of simulated time. A wait blocks for at most its lease, a
// duration of wall-clock time. If the lease ends first, the wait returns kNotYet, and the caller
// must repeat the call with the same arguments. Until the repeated call, the agent counts as
// waiting.
enum class Wait { kReached, kNotYet };

// A reading and the name of its sensor.
struct NamedReading {
  std::string sensor;
  sensing::Reading reading;  // the reading of `sensor`
};

// The result of Exchange() or SleepAndRead().
struct Exchanged {
  Wait wait = Wait::kNotYet;
  base::SimTime now{0};  // simulated time at the end of the wait
  // the readings of the sensors, by name, if `wait` is kReached
  std::vector<NamedReading> readings;
  // Whether simulated time stands still until this agent waits again (lockstep). Only
  // SleepAndRead() sets this member.
  bool holds_time = false;
};

// The state of a joint at a time.
struct JointReading {
  base::SimTime time{0};
  double position = 0;  // rad or m
  double velocity = 0;  // rad/s or m/s
};

// Returns the state of a joint. `joint` is an index in the body's model.
inline JointReading JointReadingIn(const world::Snapshot& snapshot, int body, int joint) {
  const auto index = static_cast<std::size_t>(
      snapshot.layout->bodies[static_cast<std::size_t>(body)].first_joint + joint);
  const world::State& state = snapshot.state;
  return {state.time, state.joint_positions[index], state.joint_velocities[index]};
}

class MountedSensor;

// Where a client finds the shared memory of a clock: the clock's CycleSlot and the simulation's
// Bell, see gsv/exchange/cycle_memory.h.
struct CycleMemory {
  exchange::FileAddress file;
  std::uint64_t offset = 0;  // position of the clock's CycleSlot in the file, bytes
  std::uint64_t key = 0;     // key of the Bell
};

// The interface through which one robot's behaviour uses the simulation.
class Agent {
 public:
  virtual ~Agent() = default;

  virtual const std::string& robot() const = 0;
  virtual std::string model() const = 0;
  virtual double footprint_radius() const = 0;  // m
  // Returns the pose of a link in the robot's frame, with all joints at zero. `link` is an index in
  // Model::links; link 0 is the canonical link.
  virtual geometry::Pose RobotFromLink(int link) const = 0;

  // Each thread of the behaviour waits for instants of simulated time with its own clock. An open
  // clock either runs or waits. In lockstep, the next step is taken when all open clocks of all
  // agents wait. The behaviour counts as running while one of its clocks runs. The behaviour has
  // finished when all its clocks are closed.
  virtual base::Result<ClockId> OpenClock() = 0;
  virtual base::Status CloseClock(ClockId clock) = 0;
  // Reports that the behaviour has ended with an error; call it instead of CloseClock(). From this
  // instant on, the agent counts as dead, like an agent whose process has ended. `reason` is logged
  // on one line, truncated if it is long.
  virtual base::Status GiveUp(ClockId clock, const std::string& reason) = 0;
  // Returns the current simulated time.
  virtual base::SimTime Now() const = 0;
  // Waits on this clock until the instant `until`. The call blocks for at most `lease`, see Wait.
  virtual base::Result<Wait> SleepUntil(ClockId clock, base::SimTime until,
                                        std::chrono::milliseconds lease) = 0;
  // Commands the base, waits until `until`, then reads the sensors. `cycle` numbers the exchanges
  // of this clock from 1. After kNotYet, the caller repeats the call with the same number; the
  // repeated call sends no command. Without a `command`, the last command continues to apply.
  virtual base::Result<Exchanged> Exchange(ClockId clock, std::uint64_t cycle,
                                           std::optional<world::DriveCommand> command,
                                           base::SimTime until,
                                           std::chrono::milliseconds lease) = 0;

  // Creates shared memory for the clock. Through this memory, a client on the same host can
  // exchange commands and readings without calling Exchange() and SleepAndRead(). Fails if the
  // operating system offers no such memory.
  virtual base::Result<CycleMemory> ShareMemory(ClockId clock) = 0;

  // Commands the base like Command(), waits, then reads those of `sensors` that are open. Sensors
  // that fail or take long are left out. If simulated time does not stand still until this agent
  // waits again (Exchanged::holds_time), no sensor is read.
  virtual base::Result<Exchanged> SleepAndRead(ClockId clock,
                                               std::optional<world::DriveCommand> command,
                                               base::SimTime until, std::chrono::milliseconds lease,
                                               const std::set<std::string>& sensors) = 0;

  // Commands the base from this instant until the next command, or until the drive's command
  // timeout.
  virtual base::Status Command(const world::DriveCommand& command) = 0;

  // Joints, by their index in the robot's model. A command is applied from this instant until the
  // next command. Robots with planar kinematics refuse efforts.
  virtual const std::vector<model::Joint>& Joints() const = 0;
  virtual base::Status CommandJoint(int joint, const world::JointCommand& command) = 0;
  virtual base::Result<JointReading> ReadJoint(int joint) = 0;

  // Sensors: the model's own sensors, which a behaviour opens by name, and sensors that the
  // behaviour creates.
  virtual std::vector<model::SensorDescription> Sensors() const = 0;
  virtual std::vector<std::string> SensorTypes() const = 0;
  virtual base::Status OpenSensor(const std::string& name) = 0;
  virtual base::Status CreateSensor(model::SensorDescription description) = 0;
  virtual base::Status CloseSensor(const std::string& name) = 0;
  // Takes a reading of an open sensor.
  virtual base::Result<sensing::Reading> Read(const std::string& sensor) = 0;
  // Sends a message by a radio to the robot `receiver`, or to all robots if `receiver` is empty.
  // The message is sent at this instant and arrives with the next step.
  virtual base::Status Send(const std::string& radio, const std::string& receiver,
                            std::string content) = 0;
  // Sends a command to an actuator, which is one of the sensors. It is applied from this instant
  // on.
  virtual base::Status CommandDevice(const std::string& actuator, world::DeviceCommand command) = 0;
  // Returns the sensor object. Only local behaviours use it, during their turns (see
  // robots/local_behaviour.h).
  virtual base::Result<std::shared_ptr<MountedSensor>> Mounted(const std::string& sensor) const = 0;
};

}  // namespace gsv::simulation
