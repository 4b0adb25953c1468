// An actuator: a device that behaviours command, and whose readings say what it does. Opened,
// created, recorded and shown as sensors are.
//
// Time  A command that is given at an instant acts from then on, as a robot's other commands do.
#pragma once

#include "gsv/sensing/device.h"
#include "gsv/world/actuator_state.h"

namespace gsv::sensing {

class Actuator : public Device {
 public:
  world::DeviceStatePtr Apply(const std::string& robot, const world::DeviceStatePtr& before,
                              const world::DeviceCommand& command,
                              world::DeviceStep& step) const final {
    return Follow(MountOn(robot), {command, step.now->state.time}, before.get());
  }

 protected:
  using Device::Device;

  // Its state from `followed.since` on. An actuator that others see, hear or are held by makes its
  // own kind of state. `before`: null if it has followed no command yet.
  virtual world::DeviceStatePtr Follow(world::DeviceMount mount, world::FollowedCommand followed,
                                       const world::DeviceState* /*before*/) const {
    return std::make_shared<const world::ActuatorState>(std::move(mount), std::move(followed));
  }

  // Refuses other than `count` values, and those that are not finite.
  base::Status CheckShape(const world::DeviceCommand& command, std::size_t count) const;
  // Refuses a value outside of [low, high].
  base::Status CheckRange(const char* what, double value, double low, double high) const;
};

}  // namespace gsv::sensing
