// The state of an actuator, which applies a command (Agent::CommandDevice()). If the state of an
// actuator type is only the command, the type needs no class of its own.
#pragma once

#include "gsv/world/device_state.h"

namespace gsv::world {

// The state of an actuator: its mount and its command. Actuators with more state derive from it.
class ActuatorState : public DeviceState {
 public:
  ActuatorState(DeviceMount mount, FollowedCommand followed)
      : DeviceState(std::move(mount)), followed_(std::move(followed)) {}

  const FollowedCommand* followed() const final { return &followed_; }
  const std::vector<double>& values() const { return followed_.command.values; }
  const std::string& word() const { return followed_.command.word; }
  base::SimTime since() const { return followed_.since; }

  void AddToHash(base::Hash& hash) const final;

 protected:
  // AddToHash() adds the command and then calls this function. A type with more state overrides it,
  // and adds this state. By default, it adds the grasp of a gripper that never had a body: if it added
  // nothing, the hashes of existing recordings would change.
  virtual void AddRestToHash(base::Hash& hash) const { AddGraspToHash(0, {}, 0, hash); }
  // `opening_before` is the opening of the gripper before its command, and `width` the width of the
  // grasped body, in m.
  static void AddGraspToHash(double opening_before, const Grasp& grasp, double width,
                             base::Hash& hash);

 private:
  const FollowedCommand followed_;  // the command that the actuator applies
};

}  // namespace gsv::world
