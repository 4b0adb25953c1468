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
  // AddToHash() adds the command and then these values. They are the grasp of a gripper. Other
  // types of actuators add the default values. A type that added nothing would change the hashes of
  // existing recordings.
  struct GraspForHash {
    double opening_before = 0;  // see GripperState
    Grasp grasp;
    double width = 0;  // width of the grasped body, m
  };
  virtual GraspForHash grasp_for_hash() const { return {}; }

 private:
  const FollowedCommand followed_;  // the command that the actuator applies
};

}  // namespace gsv::world
