// What a robot's behaviour commands between two steps: its drive, its joints, its devices. The next
// step takes it.
//
// Determinism  commands of one robot count in its behaviour's order; different robots' commands
//              have nothing to do with each other.
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

// What happens to one device.
struct DeviceAction {
  enum class Kind { kSwitchOn, kSwitchOff, kCommand };
  Kind kind = Kind::kCommand;
  std::shared_ptr<const sensing::Device> device;
  world::DeviceCommand command{};  // of kCommand

  const std::string& name() const { return device->description().name; }
};

// Whether behaviours command it by Agent::CommandDevice().
bool TakesCommands(const MountedSensor& sensor);
// Refuses a sensor that takes no commands, and a command that it cannot follow. `robot` is for the
// error's place.
base::Result<DeviceAction> CommandOf(const MountedSensor& sensor, world::DeviceCommand command,
                                     const std::string& robot);

class RobotCommands {
 public:
  struct Drive {
    ClockId clock = 0;  // on which it was exchanged; 0: given directly
    world::DriveCommand command;
  };

  void SetDrive(const Drive& drive) { drive_ = drive; }
  // The same, unless a command of a later clock is there.
  void OfferDrive(const Drive& drive);
  void CommandJoint(int joint, const world::JointCommand& command);
  void ForgetJoint(int joint);
  // An action on a device that makes earlier ones void replaces them.
  void Add(DeviceAction action);
  // A message by a radio to the robot `receiver` (empty: to all). Refuses what is no radio, a
  // message that is too long, and more than 64 in one step.
  base::Status Send(const MountedSensor& radio, const std::string& receiver, std::string content,
                    const std::string& robot);

  // Adds what was commanded after all of this.
  void Merge(RobotCommands later);
  // Gives all, and is empty then.
  RobotCommands Take() { return std::exchange(*this, {}); }

  bool empty() const { return !drive_ && joints_.empty() && devices_.empty(); }
  std::optional<Drive>& drive() { return drive_; }
  // Each with its index in the robot's model; the last of a joint holds.
  const std::vector<std::pair<int, world::JointCommand>>& joints() const { return joints_; }
  std::vector<DeviceAction>& devices() { return devices_; }

 private:
  std::optional<Drive> drive_;
  std::vector<std::pair<int, world::JointCommand>> joints_;
  std::vector<DeviceAction> devices_;
};

}  // namespace gsv::simulation
