// A gripper that follows a command: where its jaws are, and what they hold.
//
// Held         a held body collides as a part of the robot that holds it; it weighs nothing then,
//              and nothing else moves it.
// Determinism  grippers act in the order of their robots' names: of two that close on one body the
//              first gets it.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "gsv/world/actuator_state.h"
#include "gsv/world/device_step.h"

namespace gsv::sensing {

// A gripper's jaws lie along its x axis and close along y.
struct GripperSetup {
  double opening = 0.1;                // m, between the open jaws
  double reach = 0.08, height = 0.03;  // m, of the jaws
  double closing_time = 0.5;           // s
  std::string left_jaw, right_jaw;     // joints that show them; empty: none
};
using GripperSetupPtr = std::shared_ptr<const GripperSetup>;

class GripperState final : public world::ActuatorState {
 public:
  struct Hold {
    world::Grasp grasp;
    double width = 0;  // m, of what is held
  };

  // `opening_before`: m between the jaws at `followed.since`.
  GripperState(world::DeviceMount mount, world::FollowedCommand followed, GripperSetupPtr setup,
               double opening_before, std::optional<Hold> hold = std::nullopt);

  // What becomes of a gripper in the state `before` (null: it has followed no command yet): jaws
  // continue from where they are, and hold what they hold until they open.
  static std::shared_ptr<const GripperState> After(const world::DeviceState* before,
                                                   world::DeviceMount mount,
                                                   world::FollowedCommand followed,
                                                   GripperSetupPtr setup);

  // The command is {1} to open, {0} to close.
  bool opens() const;
  double OpeningAt(base::SimTime now) const;  // m, between its jaws
  const world::Grasp* grasp() const override { return hold_ ? &hold_->grasp : nullptr; }

  // Jaws that close in this step take hold of what is between them.
  world::DeviceStatePtr BeforeStep(world::DeviceStep& step) const override;
  // Releases a body that is not in the layout any more, or that was placed elsewhere.
  world::DeviceStatePtr CarryOver(const world::Layout& layout,
                                  const std::vector<std::string>& placed,
                                  base::SimTime now) const override;
  // Puts what is held where the gripper is, moving as it does, and the jaws of robots that no
  // forces move where they are.
  void AfterMove(const world::Layout& layout, base::SimTime time,
                 world::State& state) const override;

 private:
  GraspForHash grasp_for_hash() const override;
  void MoveFingers(const world::Body& robot, base::SimTime time, world::State& state) const;
  void MoveAttachedBody(const world::Layout& layout, int robot, world::State& state) const;

  const GripperSetupPtr setup_;
  const double opening_before_;
  const std::optional<Hold> hold_;
};

}  // namespace gsv::sensing
