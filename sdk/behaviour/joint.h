// A joint of a robot. Behaviours read it and command its position, velocity or effort.
//
// Units    rad, rad/s and N m; for prismatic joints m, m/s and N.
// Errors   as for Robot: after the end of the run every call returns at once, and readings are
//          zero.
// Threads  one behaviour, one thread.
#pragma once

#include <limits>
#include <string>

#include "gsv/base/sim_time.h"

namespace gsv {

// The name, the kind and the limits of a joint.
struct JointTraits {
  // The value of a limit that does not exist.
  static constexpr double kNone = std::numeric_limits<double>::infinity();
  std::string name;
  std::string kind;  // "revolute", "continuous", "prismatic" or "screw"
  double min_position = -kNone, max_position = kNone;
  double max_velocity = kNone;
  double max_effort = kNone;
};

// The position and the velocity of a joint at one instant.
struct JointState {
  base::SimTime time{0};
  double position = 0;
  double velocity = 0;
};

// An open joint.
class Joint {
 public:
  virtual ~Joint() = default;
  virtual const JointTraits& traits() const = 0;

  // Each command applies until the next one. MoveTo(), MoveAt() and Apply() respect the joint's
  // velocity limit and effort limit. After Release(), only damping and friction act on the joint. A
  // value that is NaN or infinite is not applied: the call throws std::invalid_argument, and the
  // behaviour may continue.
  virtual void MoveTo(double position) = 0;
  virtual void MoveAt(double velocity) = 0;
  virtual void Apply(double effort) = 0;
  virtual void Release() = 0;

  // Returns the present state of the joint.
  virtual JointState Read() = 0;
};

}  // namespace gsv
