// Dead reckoning of driven bases: from how far their wheels have turned, as a robot's own encoders
// see it.
//
// Differential  drives with two rows of wheels: the wheels of one side roll by their mean angle
//               times Drive::wheel_radius; the base follows the arc that both sides make with
//               Drive::wheel_separation between them (Siegwart, Nourbakhsh, Scaramuzza,
//               "Introduction to Autonomous Mobile Robots", chapter 5.2.4). Slip, wheels that are
//               not what the drive takes them for, and being carried away do not show in it.
// Others        all other drives: the integral of DriveState::actual. Of a planar base that is the
//               motion which its surroundings allow, so that what stops it or slows it down shows
//               in the odometry, as if a sensor saw the slip. Of a rigid body it is the motion that
//               its wheels are driven at, as above.
// Threads       one at a time.
#pragma once

#include <memory>
#include <vector>

#include "gsv/world/state.h"

namespace gsv::world {

class WheelOdometry {
 public:
  void SetLayout(const Layout& layout);

  // Around a step.
  void KeepWheels(const State& state) { before_ = state.joint_positions; }
  void Advance(double step_seconds, State& state) const;

 private:
  struct Wheel {
    int joint = 0;              // index among all bodies' joints
    double metres_per_rad = 0;  // share of its side's travel
  };
  struct Base {
    int body = 0;
    std::vector<Wheel> left, right;  // empty: no two rows of wheels
    double separation = 1;
  };

  double Travel(const std::vector<Wheel>& wheels, const State& state) const;

  std::vector<Base> bases_;
  std::vector<double> before_;
};

}  // namespace gsv::world
