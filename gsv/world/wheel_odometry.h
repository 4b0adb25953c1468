// Computes the odometry of driven bases from the rotation of their wheels, like a robot that
// measures the rotation with encoders.
//
// Differential  drives with two rows of wheels: the wheels of one side roll by their mean angle
//               times Drive::wheel_radius. The base follows the arc of both sides, with
//               Drive::wheel_separation between them (Siegwart, Nourbakhsh, Scaramuzza,
//               "Introduction to Autonomous Mobile Robots", chapter 5.2.4). As with real encoders,
//               three effects are not measured: slip, wheels whose size differs from the drive's
//               parameters, and pushes by other bodies.
// Others        all other drives: the integral of DriveState::actual. For a planar base, this is
//               the actual motion, including stops at obstacles. For a rigid body, this is the
//               commanded motion of the wheels, so slip and pushes are not measured either.
// Threads       one at a time, except that Advance() and AdvanceBody() may run concurrently for
//               different bodies.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "gsv/world/state.h"

namespace gsv::world {

class WheelOdometry {
 public:
  void SetLayout(const Layout& layout);

  // Call KeepWheels() before each step, and Advance() after it. KeepWheels() stores the wheels'
  // positions. Advance() computes the odometry from the changes of these positions.
  void KeepWheels(const State& state) { before_ = state.joint_positions; }
  void Advance(double step_seconds, State& state) const {
    Advance(step_seconds, 0, state.bodies.size(), state);
  }
  // Advances the bodies from `begin` to before `end`. Calls for different bodies may run
  // concurrently.
  void Advance(double step_seconds, std::size_t begin, std::size_t end, State& state) const;
  // Does the same as Advance() and then KeepWheels(), for one body. `steps` is the number of steps
  // since the last call. If it is above 1, the body's velocity must not have changed in these
  // steps, and its wheels must not have turned. Calls for different bodies may run concurrently.
  void AdvanceBody(double step_seconds, int body, int steps, State& state);

 private:
  struct Wheel {
    int joint = 0;              // index of the joint among all bodies' joints
    double metres_per_rad = 0;  // metres that the side travels per radian of this wheel
  };
  // A base has two rows of wheels: the left row is wheels_[left_wheel..right_wheel), and the right
  // row is wheels_[right_wheel..end_wheel). If the drive is not differential, both are empty.
  struct Base {
    int body = 0;  // index in Layout::bodies
    std::uint32_t left_wheel = 0, right_wheel = 0, end_wheel = 0;
    double separation = 1;  // distance between the two rows, m
  };

  // Advances the odometry of one base.
  void AdvanceBase(double step_seconds, const Base& base, int steps, State& state) const;
  // Returns the distance that the side with the wheels from `begin` to `end` has travelled since
  // KeepWheels(), m.
  double Travel(std::uint32_t begin, std::uint32_t end, const State& state) const;

  std::vector<Base> bases_;     // ordered by body
  std::vector<int> base_of_;    // index in bases_ of each body; -1 if it has no base
  std::vector<Wheel> wheels_;   // the wheels of all bases
  std::vector<double> before_;  // State::joint_positions at KeepWheels()
};

}  // namespace gsv::world
