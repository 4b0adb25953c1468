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

class Device : public Sensor {
 public:
  const Device* device() const final { return this; }

  // Whether it has a state while it is open, like a radio. Other devices have a state from their
  // first command until they are removed from the robot.
  virtual bool IsOnWhileOpen() const { return false; }
  // Whether its commands are messages, each of which is sent: `word` is the receiving robot, and
  // `content` the message. For other devices the last command of a step applies.
  virtual bool SendsMessages() const { return false; }
  // The initial command.
  virtual std::optional<world::DeviceCommand> first() const { return std::nullopt; }
  // Rejects an invalid command.
  virtual base::Status Check(const world::DeviceCommand& command) const = 0;

  // Returns its state when it is opened; for devices with IsOnWhileOpen().
  virtual world::DeviceStatePtr SwitchedOn(const std::string& /*robot*/) const { return nullptr; }
  // Returns its state with `command` applied from the step's instant on. `before` is null if it has
  // none.
  virtual world::DeviceStatePtr Apply(const std::string& robot, const world::DeviceStatePtr& before,
                                      const world::DeviceCommand& command,
                                      world::DeviceStep& step) const = 0;

 protected:
  using Sensor::Sensor;

  world::DeviceMount MountOn(const std::string& robot) const {
    return {robot, description().name, description().link, description().link_from_sensor};
  }
  // Returns its state, or null if it has none.
  const world::DeviceState* StateIn(const Sampling& sampling) const {
    return world::FindDevice(sampling.snapshot()->state.devices.get(), sampling.robot().name,
                             description().name);
  }
  base::Status Refuse(std::string sentence) const {
    return base::Fail(base::ErrorCode::kInvalidArgument, std::move(sentence), description().name);
  }
};

}  // namespace gsv::sensing
