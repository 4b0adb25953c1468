// Computes the odometry of driven bases from the rotation of their wheels, which a robot's encoders
// would measure.
//
// Differential  drives with two rows of wheels: the wheels of one side roll by their mean angle
//               times Drive::wheel_radius; the base follows the arc that both sides make with
//               Drive::wheel_separation between them (Siegwart, Nourbakhsh, Scaramuzza,
//               "Introduction to Autonomous Mobile Robots", chapter 5.2.4). Slip, wheels that
//               differ from the drive's parameters, and external motion do not show.
// Others        all other drives: the integral of DriveState::actual. For a planar base this is the
//               motion that obstacles allow. So stops at obstacles appear in the odometry, as if a
//               sensor measured the slip. For a rigid body it is the commanded motion of the
//               wheels, as above.
// Threads       one at a time.
#pragma once

#include <memory>
#include <vector>

#include "gsv/world/state.h"

namespace gsv::world {

class WheelOdometry {
 public:
  void SetLayout(const Layout& layout);

  // Called before and after each step.
  void KeepWheels(const State& state) { before_ = state.joint_positions; }
  void Advance(double step_seconds, State& state) const;

 private:
  struct Wheel {
    int joint = 0;              // index of the joint among all bodies' joints
    double metres_per_rad = 0;  // metres that the side travels per radian of this wheel
  };
  struct Base {
    int body = 0;
    std::vector<Wheel> left, right;  // empty if the drive does not have two rows of wheels
    double separation = 1;
  };

  double Travel(const std::vector<Wheel>& wheels, const State& state) const;

  std::vector<Base> bases_;
  std::vector<double> before_;
};

}  // namespace gsv::world
