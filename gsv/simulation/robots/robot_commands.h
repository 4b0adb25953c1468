// The commands that a robot's behaviour has given between two steps: to drive, joints and devices.
// The next step applies them.
//
// Determinism  commands of one robot are applied in the order of its behaviour. Commands of
//              different robots are independent.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "gsv/sensing/device.h"
#include "gsv/simulation/agent.h"
#include "gsv/simulation/robots/mounted_sensor.h"

namespace gsv::simulation {

// An action on one device.
struct DeviceAction {
  enum class Kind { kSwitchOn, kSwitchOff, kCommand };
  Kind kind = Kind::kCommand;
  std::shared_ptr<const sensing::Device> device;
  world::DeviceCommand command{};  // for kCommand only

  const std::string& name() const { return device->description().name; }
};

// Whether the sensor accepts Agent::CommandDevice().
bool TakesCommands(const MountedSensor& sensor);
// Converts a command to an action. Fails if the sensor accepts no commands, or if the command is
// invalid. Error messages name `robot`.
base::Result<DeviceAction> CommandOf(const MountedSensor& sensor, world::DeviceCommand command,
                                     const std::string& robot);

// The commands that one robot has received since the last step.
class RobotCommands {
 public:
  // A command to the drive, with its origin.
  struct Drive {
    ClockId clock = 0;  // the clock of the exchange that sent the command; 0 if there was none
    world::DriveCommand command;
  };

  void SetDrive(const Drive& drive) { drive_ = drive; }
  // Sets the drive command. If the command that is already set came from a clock with a higher id,
  // does nothing.
  void OfferDrive(const Drive& drive);
  void CommandJoint(int joint, const world::JointCommand& command);
  // Removes the command of a joint.
  void ForgetJoint(int joint);
  // Adds an action, and removes earlier actions that the new one replaces.
  void Add(DeviceAction action);
  // Adds a message of a radio to the robot `receiver`, or to all robots if `receiver` is empty.
  // Fails for a sensor that is not a radio, a message that is too long, and more than 64 messages
  // in one step.
  base::Status Send(const MountedSensor& radio, const std::string& receiver, std::string content,
                    const std::string& robot);

  // Adds commands that were given later, and clears `later`.
  void Merge(RobotCommands&& later);
  // Returns all commands and clears them.
  RobotCommands Take() { return std::exchange(*this, {}); }

  // Clears all commands. Keeps the memory for later ones.
  void Clear() {
    drive_.reset();
    joints_.clear();
    devices_.clear();
  }

  bool empty() const { return !drive_ && joints_.empty() && devices_.empty(); }
  bool has_only_drive() const { return drive_ && joints_.empty() && devices_.empty(); }
  std::optional<Drive>& drive() { return drive_; }
  // Commands of joints, by index in the robot's model. For each joint, the last command applies.
  const std::vector<std::pair<int, world::JointCommand>>& joints() const { return joints_; }
  // Actions on sensors, actuators and radios, in the order in which they were added.
  std::vector<DeviceAction>& devices() { return devices_; }

 private:
  std::optional<Drive> drive_;
  std::vector<std::pair<int, world::JointCommand>> joints_;  // by index of the joint in the model
  std::vector<DeviceAction> devices_;                        // see devices()
};

}  // namespace gsv::simulation
