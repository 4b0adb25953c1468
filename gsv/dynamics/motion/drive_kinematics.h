// Computes how a wheeled base follows its commands: its velocity within its limits, the twist of
// its frame, and the rotation of its wheels.
//
// Frames   the model's frame. A command is the velocity of the drive's reference point. This point
//          is halfway between the wheels along x, or on the rear axle for Ackermann steering. For a
//          base without wheels, it is the model's origin.
// Slip     the slip of a drive (model::Slip) is computed from the forces at a constant speed. On an
//          arc, the side force m v w makes the base drift outwards at lateral * v w / g * |v|. The
//          base rotates by only a fraction of the rotation that the wheels command: b² /
//          (b² + longitudinal / lateral * x²). Here b is half of the wheel separation, and x² is
//          the mean square of the wheels' distances along x from the reference point. This applies
//          if both compliances are above 0. Slip during acceleration is not modelled.
// Source   for the wheels' equations: Siegwart, Nourbakhsh, Scaramuzza, "Introduction to Autonomous
//          Mobile Robots", 2nd edition, chapter 3.
#pragma once

#include <cmath>
#include <span>
#include <string>
#include <vector>

#include "gsv/base/error.h"
#include "gsv/geometry/planar_motion.h"
#include "gsv/model/model.h"
#include "gsv/world/state.h"

namespace gsv::dynamics {

// The maximum speeds of every base, even if its own limits are higher.
inline constexpr double kMaxLinearSpeed = 100;   // m/s
inline constexpr double kMaxAngularSpeed = 100;  // rad/s

// The distance that a base's reference point has covered in a step, in the base's frame, and the
// change of the base's heading.
struct Travel {
  double forward = 0, left = 0, angle = 0;  // m, m, rad
};

// The kinematics of one drive: how its base and its wheels move for a command.
class DriveKinematics {
 public:
  // Rejects invalid limits and dimensions, and joints that do not exist.
  static base::Result<DriveKinematics> Create(const model::Model& model);

  // Returns the kinematics of a person or of any other body without a drive: it accepts any
  // velocity.
  static DriveKinematics Free();

  // Returns the velocities in the next step, from the velocities and the last command in `state`. A
  // command that is older than the drive's timeout is ignored, and non-finite values count as zero.
  // Defined in this header for speed, because it is called for each base in each step.
  world::DriveCommand Next(const world::DriveState& state, base::SimTime now,
                           double step_seconds) const;

  // Whether Next() follows the command in `state` at `now`, and ignores it at `later`.
  bool BecomesStale(const world::DriveState& state, base::SimTime now, base::SimTime later) const {
    return IsStale(state, now) != IsStale(state, later);
  }

  // The motion of the reference point when the drive rotates the wheels for `motion`. It equals
  // `motion` unless the wheels slip or their true radii differ from the radii that the drive
  // assumes.
  world::DriveCommand TrueMotion(const world::DriveCommand& motion) const;

  // The twist of the model's origin when the drive rotates the wheels for `motion`.
  geometry::Twist OriginTwist(const world::DriveCommand& motion) const {
    const bool is_true = wheels_are_as_believed_ && !slips_;
    const world::DriveCommand moves = is_true ? motion : TrueMotion(motion);
    return {moves.linear, moves.lateral - moves.angular * reference_x_, moves.angular};
  }

  // Upper bounds of the linear speed (m/s) of the model's origin and of the angular speed (rad/s).
  struct Speeds {
    double linear = 0, angular = 0;
  };
  // Returns bounds for the next `steps` steps, if the base follows the command in `state`. They
  // also apply if obstacles stop the base or if it slides along them.
  Speeds MaxSpeeds(const world::DriveState& state, int steps) const;

  // Whether the base can rotate without moving forwards.
  bool can_turn_on_the_spot() const {
    return drive_.kind != model::DriveKind::kAckermann && drive_.kind != model::DriveKind::kNone;
  }
  // Whether the base may slide along an obstacle.
  bool can_move_sideways() const {
    return drive_.kind == model::DriveKind::kMecanum || drive_.kind == model::DriveKind::kVelocity;
  }
  // The x coordinate of the drive's reference point in the model's frame, m.
  double reference_x() const { return reference_x_; }

  // Whether TurnJoints() sets any joint.
  bool turns_joints() const { return !wheels_.empty() || !steered_.empty(); }
  // Sets the joints of wheels and steering according to the base's travel and its present motion.
  // The spans have an entry for each joint of the model.
  void TurnJoints(const Travel& travel, const world::DriveCommand& motion, double step_seconds,
                  std::span<double> positions, std::span<double> velocities) const;

 private:
  // A wheel rotates by forward * travel.forward + left * travel.left + angle * travel.angle. A
  // wheel in front of the rear axle of an Ackermann base rolls along its own steered path instead.
  struct Wheel {
    int joint = 0;                            // index of the wheel's joint in the model
    double forward = 0, left = 0, angle = 0;  // rad/m, rad/m, rad/rad
    double ahead = 0;                         // distance in front of the rear axle, m
  };
  // A joint that steers a wheel.
  struct Steered {
    int joint = 0;       // index of the steering joint in the model
    double sign = 1;     // sign of the z component of the joint's axis
    double lateral = 0;  // y coordinate of the joint in the model's frame, m; left is positive
  };

  // Whether the command is older than the drive's timeout.
  bool IsStale(const world::DriveState& state, base::SimTime now) const {
    return drive_.command_timeout > base::SimTime(0) &&
           now - state.command_time >= drive_.command_timeout;
  }
  // Adds the wheels of one side. `side` is 1 for the left and -1 for the right.
  void AddWheels(const model::Model& model, const std::vector<int>& joints, double side);
  // Computes from the slip of the drive and its wheels how much less the base turns than commanded.
  void SetSlip(const model::Model& model);
  // Limits the rotation to what the steering allows.
  void LimitTurn(world::DriveCommand& motion) const;
  // TrueMotion() without slip: the motion of wheels that roll.
  world::DriveCommand RolledMotion(const world::DriveCommand& motion) const;
  // Returns the rotation of a wheel (rad) while the base travels.
  double RollOf(const Wheel& wheel, const Travel& travel) const;
  // Returns the angle of a steering joint (rad) for a path of this curvature (1/m).
  double SteeringAngle(const Steered& steered, double curvature) const;

  model::Drive drive_;                  // the model's drive; of kind kVelocity for Free()
  double reference_x_ = 0;              // see reference_x()
  bool wheels_are_as_believed_ = true;  // whether the wheels have the radii that the drive assumes
  bool slips_ = false;                  // whether the drive's wheels slip, see "Slip" above
  double turn_share_ = 1;  // the base's turn rate divided by its turn rate without slip, in (0, 1]
  std::vector<Wheel> wheels_;     // the wheels that roll while the base travels
  std::vector<Steered> steered_;  // the joints that steer wheels; empty if none do
};

// Equals std::clamp(value, low, high), but takes no branches.
inline double Limited(double value, double low, double high) {
  const double from_low = value < low ? low : value;
  return high < from_low ? high : from_low;
}

// Returns the speed at the end of a step of `seconds`. In this step, the speed changes from `now`
// towards `target` within the limits.
[[gnu::always_inline]] inline double FollowSpeed(double target, double now,
                                                 const model::Range& speed,
                                                 const model::Range& acceleration, double seconds,
                                                 double max_speed) {
  if (!std::isfinite(target)) target = 0;
  target = Limited(Limited(target, speed.min, speed.max), -max_speed, max_speed);
  return now + Limited(target - now, acceleration.min * seconds, acceleration.max * seconds);
}

[[gnu::always_inline]] inline world::DriveCommand DriveKinematics::Next(
    const world::DriveState& state, base::SimTime now, double step_seconds) const {
  const bool stale = IsStale(state, now);
  if (drive_.kind == model::DriveKind::kNone) return {};
  const world::DriveCommand target = stale ? world::DriveCommand{} : state.command;
  world::DriveCommand next;
  next.linear = FollowSpeed(target.linear, state.actual.linear, drive_.linear_velocity,
                            drive_.linear_acceleration, step_seconds, kMaxLinearSpeed);
  if (can_move_sideways()) {
    next.lateral = FollowSpeed(target.lateral, state.actual.lateral, drive_.linear_velocity,
                               drive_.linear_acceleration, step_seconds, kMaxLinearSpeed);
  }
  next.angular = FollowSpeed(target.angular, state.actual.angular, drive_.angular_velocity,
                             drive_.angular_acceleration, step_seconds, kMaxAngularSpeed);
  if (drive_.kind == model::DriveKind::kAckermann) LimitTurn(next);
  return next;
}

}  // namespace gsv::dynamics
