// An actuator that follows a command: the state of every device that behaviours command by
// Agent::CommandDevice(). Types whose command alone says what they do need no class of their own.
#pragma once

#include "gsv/world/device_state.h"

namespace gsv::world {

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
  // What a gripper adds to the hash of its command. Other types add the same of a gripper that is
  // closed and empty: so do all hashes that have ever been recorded.
  struct GraspForHash {
    double opening_before = 0;
    Grasp grasp;
    double width = 0;
  };
  virtual GraspForHash grasp_for_hash() const { return {}; }

 private:
  const FollowedCommand followed_;
};

}  // namespace gsv::world
