// The drive of a robot's base: its kind, its wheels and its limits.
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "gsv/base/sim_time.h"

namespace gsv::model {

// The kinematics of a base.
enum class DriveKind {
  kDifferential,  // two wheels, or two rows of them (skid steer)
  kSynchro,       // all wheels turn and steer together, so the base moves along its heading
  kAckermann,     // steered front wheels: cannot turn on the spot
  kMecanum,       // four wheels with rollers; can also move sideways
  kVelocity,      // omnidirectional: follows any velocity in the plane
  kNone,          // the base does not move; only joints can be commanded
};

// Where a drive's description comes from.
enum class DriveOrigin {
  kPlugin,   // an element of the model file
  kGuessed,  // guessed from the shapes of the wheels, see drive_guess.h
  kChosen,   // chosen by the user, see drive_choice.h
};

// An interval of allowed values. An infinite bound means no limit.
struct Range {
  double min = -std::numeric_limits<double>::infinity();
  double max = std::numeric_limits<double>::infinity();
};

// The slip compliance of a wheel, without unit, as in Gazebo's WheelSlip: slip speed = compliance *
// |rolling speed| * friction force / normal force. A compliance of 0 means no slip up to the
// friction limit. Example: with a compliance of 1, a friction force of a tenth of the normal force
// gives a slip speed of a tenth of the rolling speed.
struct Slip {
  double longitudinal = 0;  // along the wheel's rolling direction
  double lateral = 0;       // along the wheel's axle
  bool is_none() const { return longitudinal == 0 && lateral == 0; }
};

// Units  m, rad, s. Joints are indices in Model::joints.
struct Drive {
  DriveKind kind = DriveKind::kDifferential;
  // Joints that turn the wheels of the left and of the right side.
  std::vector<int> left_wheels;
  std::vector<int> right_wheels;
  std::vector<int> steered;       // kAckermann: steering joints
  double wheel_separation = 0.3;  // distance between the left and right contact points
  double wheel_radius = 0.1;      // the radius with which the drive computes wheel speeds
  // kDifferential: the true radius of the left and of the right wheels, divided by wheel_radius.
  // The drive computes wheel speeds with wheel_radius.
  double left_wheel_scale = 1, right_wheel_scale = 1;
  double wheel_base = 0;  // kAckermann, kMecanum: distance from front to rear axle
  // The largest angle to which the front wheels can be steered, to the left and to the right.
  double steering_limit = 0.5;  // kAckermann
  // Limits of the base's commanded motion.
  Range linear_velocity, angular_velocity;
  Range linear_acceleration, angular_acceleration;
  Slip slip;  // used for wheels whose own slip is not set
  // After this time without a command the base brakes; zero means never.
  base::SimTime command_timeout{0};
  DriveOrigin origin = DriveOrigin::kPlugin;
  std::string choice;  // kChosen: the user's text, see drive_choice.h
};

}  // namespace gsv::model
