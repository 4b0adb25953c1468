// A device: a sensor that keeps a state from one step to the next (world::DeviceState). Radios are
// devices, and all actuators are.
//
// Threads  const members may run concurrently. Apply() and SwitchedOn() are called by the stepping
//          thread.
#pragma once

#include <optional>
#include <string>

#include "gsv/sensing/sensor.h"
#include "gsv/world/device_step.h"

namespace gsv::sensing {

class Device : public Sensor {
 public:
  const Device* device() const final { return this; }

  // Whether it has a state while it is open, as a radio has. Other devices have one from their
  // first command on, until they are removed from the robot.
  virtual bool IsOnWhileOpen() const { return false; }
  // Whether its commands are messages (`word`: the receiving robot, `content`), each of which is
  // sent. Of other commands the last of a step holds.
  virtual bool SendsMessages() const { return false; }
  // The command that it follows from the start.
  virtual std::optional<world::DeviceCommand> first() const { return std::nullopt; }
  // Refuses a command that it cannot follow.
  virtual base::Status Check(const world::DeviceCommand& command) const = 0;

  // Its state when it is switched on; for devices that are on while they are open.
  virtual world::DeviceStatePtr SwitchedOn(const std::string& /*robot*/) const { return nullptr; }
  // Its state when `command` acts from the step's instant on. `before` is null where it has none.
  virtual world::DeviceStatePtr Apply(const std::string& robot, const world::DeviceStatePtr& before,
                                      const world::DeviceCommand& command,
                                      world::DeviceStep& step) const = 0;

 protected:
  using Sensor::Sensor;

  world::DeviceMount MountOn(const std::string& robot) const {
    return {robot, description().name, description().link, description().link_from_sensor};
  }
  // Null as long as it has none.
  const world::DeviceState* StateIn(const Sampling& sampling) const {
    return world::FindDevice(sampling.snapshot()->state.devices.get(), sampling.robot().name,
                             description().name);
  }
  base::Status Refuse(std::string sentence) const {
    return base::Fail(base::ErrorCode::kInvalidArgument, std::move(sentence), description().name);
  }
};

}  // namespace gsv::sensing
