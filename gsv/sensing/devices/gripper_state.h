// The state of a gripper that follows a command: its fingers and its attachment.
//
// Attachment   an attached body collides as a part of the robot. It has no weight, and only the
//              gripper moves it.
// Determinism  grippers are stepped in the order of their robots' names. If two grippers close on
//              one body, the first gripper in this order attaches it.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "gsv/world/actuator_state.h"
#include "gsv/world/device_step.h"

namespace gsv::sensing {

// A gripper's fingers lie along its x axis and close along y.
struct GripperSetup {
  double opening = 0.1;                   // distance between the open fingers, m
  double reach = 0.08, height = 0.03;     // length and height of the fingers, m
  double closing_time = 0.5;              // s
  std::string left_finger, right_finger;  // names of the fingers' joints; empty: none
};
using GripperSetupPtr = std::shared_ptr<const GripperSetup>;

// A gripper's state since its last command.
class GripperState final : public world::ActuatorState {
 public:
  // An attached body.
  struct Hold {
    world::Grasp grasp;  // the body, and where the gripper holds it
    double width = 0;    // width of the attached body, m
  };

  // `opening_before` is the distance between the fingers (m) when the command was applied
  // (`followed.since`).
  GripperState(world::DeviceMount mount, world::FollowedCommand followed, GripperSetupPtr setup,
               double opening_before, std::optional<Hold> hold = std::nullopt);

  // Returns the state after a new command. `before` is the gripper's previous state (null: no
  // command yet). Fingers continue from their opening, and keep an attachment until they open.
  static std::shared_ptr<const GripperState> After(const world::DeviceState* before,
                                                   world::DeviceMount mount,
                                                   world::FollowedCommand followed,
                                                   GripperSetupPtr setup);

  // Whether the command is {1}, to open. {0} is the command to close.
  bool opens() const;
  double OpeningAt(base::SimTime now) const;  // Returns the distance between the fingers, m.
  // The attachment of the body between the fingers; null if there is none.
  const world::Grasp* grasp() const override { return hold_ ? &hold_->grasp : nullptr; }

  // Attaches the body between fingers that close in this step.
  world::DeviceStatePtr BeforeStep(world::DeviceStep& step) const override;
  // Returns the state after a change of the world's bodies. Releases the attached body if it was
  // removed or placed.
  world::DeviceStatePtr CarryOver(const world::Layout& layout,
                                  const std::vector<std::string>& placed,
                                  base::SimTime now) const override;
  // Sets pose and velocity of the attached body, and the finger joints of robots with planar
  // kinematics.
  void AfterMove(const world::Layout& layout, base::SimTime time,
                 world::State& state) const override;

 private:
  void AddRestToHash(base::Hash& hash) const override;
  // Sets the finger joints of a robot with planar kinematics.
  void MoveFingers(const world::Body& robot, base::SimTime time, world::State& state) const;
  // Sets the pose and velocity of the attached body.
  void MoveAttachedBody(const world::Layout& layout, int robot, world::State& state) const;

  const GripperSetupPtr setup_;
  const double opening_before_;     // distance between the fingers at followed().since, m
  const std::optional<Hold> hold_;  // nullopt if no body is attached
};

}  // namespace gsv::sensing
