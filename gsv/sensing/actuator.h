// An actuator: a device that behaviours command and whose readings report its state. Actuators are
// opened, created, recorded and shown like sensors.
//
// Time  A command is applied from the instant at which it is given, like a robot's other commands.
#pragma once

#include "gsv/sensing/device.h"
#include "gsv/world/actuator_state.h"

namespace gsv::sensing {

// Base class of devices that take commands.
class Actuator : public Device {
 public:
  world::DeviceStatePtr Apply(const std::string& robot, const world::DeviceStatePtr& before,
                              const world::DeviceCommand& command,
                              world::DeviceStep& step) const final {
    return Follow(MountOn(robot), {command, step.now->state.time}, before.get());
  }

 protected:
  using Device::Device;

  // Returns the actuator's state under the command `followed.command`, which applies from
  // `followed.since` on. An actuator with light, sound or an attached body returns its own class of
  // state. `before` is the state before the command; it is null for the first command.
  virtual world::DeviceStatePtr Follow(world::DeviceMount mount, world::FollowedCommand followed,
                                       const world::DeviceState* /*before*/) const {
    return std::make_shared<const world::ActuatorState>(std::move(mount), std::move(followed));
  }

  // Returns an error for a command that does not have exactly `count` values, all of them finite.
  base::Status CheckShape(const world::DeviceCommand& command, std::size_t count) const;
  // Returns an error that names `what` if the value is outside of [low, high].
  base::Status CheckRange(const char* what, double value, double low, double high) const;
};

}  // namespace gsv::sensing
