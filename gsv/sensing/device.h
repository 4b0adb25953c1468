// A device is a sensor that keeps a state between steps (world::DeviceState). Radios and actuators
// are devices.
//
// Threads  const members may run concurrently. The stepping thread calls Apply() and SwitchedOn().
#pragma once

#include <optional>
#include <string>

#include "gsv/sensing/sensor.h"
#include "gsv/world/device_step.h"

namespace gsv::sensing {

// Base class of sensors that keep a state between steps.
class Device : public Sensor {
 public:
  const Device* device() const final { return this; }

  // Whether the device is switched on by opening it and switched off by closing it, like a radio.
  // Other devices get their state from their first command, and keep the state until they are
  // removed from the robot.
  virtual bool IsOnWhileOpen() const { return false; }
  // Whether each command is a message to send, with the receiving robot in `word` and the message
  // in `content`. For other devices, only the last command of a step applies.
  virtual bool SendsMessages() const { return false; }
  // The initial command.
  virtual std::optional<world::DeviceCommand> first() const { return std::nullopt; }
  // Rejects an invalid command.
  virtual base::Status Check(const world::DeviceCommand& command) const = 0;

  // Returns the device's state when it is opened; for devices with IsOnWhileOpen().
  virtual world::DeviceStatePtr SwitchedOn(const std::string& /*robot*/) const { return nullptr; }
  // Returns the device's state after `command`, which applies from the step's instant on. `before`
  // is the state before the command, or null.
  virtual world::DeviceStatePtr Apply(const std::string& robot, const world::DeviceStatePtr& before,
                                      const world::DeviceCommand& command,
                                      world::DeviceStep& step) const = 0;

 protected:
  using Sensor::Sensor;

  // Returns where this device is mounted on a robot.
  world::DeviceMount MountOn(const std::string& robot) const {
    return {robot, description().name, description().link, description().link_from_sensor};
  }
  // Returns the device's state in the snapshot, or null if the device has no state.
  const world::DeviceState* StateIn(const Sampling& sampling) const {
    return world::FindDevice(sampling.snapshot()->state.devices.get(), sampling.robot().name,
                             description().name);
  }
  // Returns a kInvalidArgument error with this sentence.
  base::Status Refuse(std::string sentence) const {
    return base::Fail(base::ErrorCode::kInvalidArgument, std::move(sentence), description().name);
  }
};

}  // namespace gsv::sensing
