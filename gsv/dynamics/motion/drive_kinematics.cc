#include "gsv/dynamics/motion/drive_kinematics.h"

#include <algorithm>
#include <limits>

#include <fmt/format.h>

namespace gsv::dynamics {
namespace {

using base::ErrorCode;
using geometry::Vector3;
using model::DriveKind;

constexpr double kStandardGravity = 9.80665;  // m/s²
constexpr double kUnlimited = std::numeric_limits<double>::infinity();

base::Status CheckRange(const model::Range& range, const char* what, double must_contain) {
  if (!(range.min <= range.max)) {
    return base::Fail(ErrorCode::kBadModel, fmt::format("the drive's {} has min {} above max {}",
                                                        what, range.min, range.max));
  }
  if (!(range.min <= must_contain && must_contain <= range.max)) {
    return base::Fail(ErrorCode::kBadModel,
                      fmt::format("the drive's {} from {} to {} must include {}", what, range.min,
                                  range.max, must_contain));
  }
  return {};
}

base::Status CheckPositive(double value, const char* what) {
  if (value > 0 && std::isfinite(value)) return {};
  return base::Fail(ErrorCode::kBadModel,
                    fmt::format("the drive's {} is {}; it must be above 0", what, value));
}

base::Status CheckJoints(const model::Model& model, const std::vector<int>& joints) {
  for (const int joint : joints) {
    if (joint < 0 || joint >= static_cast<int>(model.joints.size())) {
      return base::Fail(ErrorCode::kBadModel,
                        fmt::format("the drive names joint {}, but the model has {} joints", joint,
                                    model.joints.size()));
    }
  }
  return {};
}

base::Status Check(const model::Model& model) {
  const model::Drive& drive = *model.drive;
  base::Status status = CheckRange(drive.linear_velocity, "linear velocity", 0);
  if (status) status = CheckRange(drive.angular_velocity, "angular velocity", 0);
  if (status) status = CheckRange(drive.linear_acceleration, "linear acceleration", 0);
  if (status) status = CheckRange(drive.angular_acceleration, "angular acceleration", 0);
  for (const auto* joints : {&drive.left_wheels, &drive.right_wheels, &drive.steered}) {
    if (status) status = CheckJoints(model, *joints);
  }
  if (status && !(drive.left_wheels.empty() && drive.right_wheels.empty())) {
    status = CheckPositive(drive.wheel_radius, "wheel radius");
    if (status) status = CheckPositive(drive.wheel_separation, "wheel separation");
  }
  if (status) status = CheckPositive(drive.left_wheel_scale, "left wheel's scale");
  if (status) status = CheckPositive(drive.right_wheel_scale, "right wheel's scale");
  if (status && drive.kind == DriveKind::kAckermann) {
    status = CheckPositive(drive.wheel_base, "wheel base");
    if (status && !(drive.steering_limit > 0 && drive.steering_limit < 1.57)) {
      return base::Fail(
          ErrorCode::kBadModel,
          fmt::format("the drive's steering limit is {} rad; it must lie between 0 and 1.57 rad",
                      drive.steering_limit));
    }
  }
  return status;
}

// The x coordinate of the drive's reference point in the model's frame.
double ReferenceX(const model::Model& model) {
  const model::Drive& drive = *model.drive;
  double sum = 0, rearmost = 0;
  int count = 0;
  for (const auto* joints : {&drive.left_wheels, &drive.right_wheels}) {
    for (const int joint : *joints) {
      const double x = model.joints[joint].model_from_joint.position.x;
      sum += x;
      rearmost = count == 0 ? x : std::min(rearmost, x);
      ++count;
    }
  }
  if (count == 0 || drive.kind == DriveKind::kVelocity) return 0;
  return drive.kind == DriveKind::kAckermann ? rearmost : sum / count;
}

// Returns the mean slip of the drive's wheels, as if each wheel carried an equal share of the
// weight. The compliance of a wheel with its own slip (Gazebo's WheelSlip) refers to the wheel's
// normal_force and radius. It is converted to the equal share of the weight and to the drive's
// wheel radius.
model::Slip MeanSlip(const model::Model& model) {
  const model::Drive& drive = *model.drive;
  const auto has_own = [](const model::Link& link) { return link.wheel.has_value(); };
  if (std::none_of(model.links.begin(), model.links.end(), has_own)) return drive.slip;
  double mass = 0;
  for (const model::Link& link : model.links) mass += link.inertial.mass;
  const auto count = static_cast<double>(drive.left_wheels.size() + drive.right_wheels.size());
  const double load = mass * kStandardGravity / count;  // N
  model::Slip mean;
  for (const auto* joints : {&drive.left_wheels, &drive.right_wheels}) {
    for (const int joint : *joints) {
      const auto& wheel = model.links[model.joints[joint].child].wheel;
      const double scale =
          wheel ? load / wheel->normal_force * wheel->radius / drive.wheel_radius : 1;
      const model::Slip& slip = wheel ? wheel->slip : drive.slip;
      mean.longitudinal += slip.longitudinal * scale / count;
      mean.lateral += slip.lateral * scale / count;
    }
  }
  return mean;
}

}  // namespace

base::Result<DriveKinematics> DriveKinematics::Create(const model::Model& model) {
  if (base::Status status = Check(model); !status) {
    status.error().where = model.source.empty() ? model.name : model.source;
    return base::Fail(status.error());
  }
  DriveKinematics kinematics;
  kinematics.drive_ = *model.drive;
  kinematics.reference_x_ = ReferenceX(model);
  kinematics.wheels_are_as_believed_ =
      model.drive->kind != DriveKind::kDifferential ||
      (model.drive->left_wheel_scale == 1 && model.drive->right_wheel_scale == 1);
  kinematics.SetSlip(model);
  kinematics.AddWheels(model, model.drive->left_wheels, 1);
  kinematics.AddWheels(model, model.drive->right_wheels, -1);
  for (const int joint : model.drive->steered) {
    const geometry::Pose& pose = model.joints[joint].model_from_joint;
    const double up = (pose.orientation * model.joints[joint].axis).z;
    kinematics.steered_.push_back({joint, up < 0 ? -1.0 : 1.0, pose.position.y});
  }
  return kinematics;
}

DriveKinematics DriveKinematics::Free() {
  DriveKinematics kinematics;
  kinematics.drive_.kind = DriveKind::kVelocity;
  return kinematics;
}

void DriveKinematics::AddWheels(const model::Model& model, const std::vector<int>& joints,
                                double side) {
  const double to_side = side * drive_.wheel_separation / 2;
  for (const int joint : joints) {
    const geometry::Pose& pose = model.joints[joint].model_from_joint;
    // If the axis of a wheel points to the left, a positive rate rolls the wheel forwards.
    const bool backwards = (pose.orientation * model.joints[joint].axis).y < 0;
    const double scale = side > 0 ? drive_.left_wheel_scale : drive_.right_wheel_scale;
    const double radius =
        wheels_are_as_believed_ ? drive_.wheel_radius : drive_.wheel_radius * scale;
    const double per_metre = (backwards ? -1 : 1) / radius;
    const double ahead = pose.position.x - reference_x_;
    Wheel wheel{joint, per_metre, 0, -to_side * per_metre, 0};
    if (drive_.kind == DriveKind::kSynchro) wheel.angle = 0;
    if (drive_.kind == DriveKind::kAckermann && ahead > 1e-6) wheel.ahead = ahead;
    if (drive_.kind == DriveKind::kMecanum) {
      // With rollers at 45°, the rollers form an X when seen from above.
      const double diagonal = ahead < 0 ? 1 : -1;
      wheel.left = side * diagonal * per_metre;
      wheel.angle = -side * (drive_.wheel_separation + drive_.wheel_base) / 2 * per_metre;
    }
    wheels_.push_back(wheel);
  }
}

void DriveKinematics::LimitTurn(world::DriveCommand& motion) const {
  const double fastest_turn =
      std::abs(motion.linear) * std::tan(drive_.steering_limit) / drive_.wheel_base;
  motion.angular = std::clamp(motion.angular, -fastest_turn, fastest_turn);
}

void DriveKinematics::SetSlip(const model::Model& model) {
  const bool rolls =
      drive_.kind == DriveKind::kDifferential || drive_.kind == DriveKind::kAckermann;
  if (rolls && !drive_.left_wheels.empty()) drive_.slip = MeanSlip(model);
  slips_ = rolls && !drive_.slip.is_none() && !drive_.left_wheels.empty();
  // Steered wheels roll without sliding sideways.
  if (!slips_ || drive_.kind == DriveKind::kAckermann || !(drive_.slip.lateral > 0)) return;
  double square = 0;
  for (const auto* joints : {&drive_.left_wheels, &drive_.right_wheels}) {
    for (const int joint : *joints) {
      const double ahead = model.joints[joint].model_from_joint.position.x - reference_x_;
      square += ahead * ahead;
    }
  }
  square /= static_cast<double>(drive_.left_wheels.size() + drive_.right_wheels.size());
  const double half = drive_.wheel_separation / 2;
  turn_share_ =
      half * half / (half * half + drive_.slip.longitudinal / drive_.slip.lateral * square);
}

world::DriveCommand DriveKinematics::TrueMotion(const world::DriveCommand& motion) const {
  world::DriveCommand moves = wheels_are_as_believed_ ? motion : RolledMotion(motion);
  if (!slips_) return moves;
  moves.angular *= turn_share_;
  // the side force divided by the weight
  const double side_force = moves.linear * moves.angular / kStandardGravity;
  moves.lateral -= drive_.slip.lateral * side_force * std::abs(moves.linear);
  return moves;
}

DriveKinematics::Speeds DriveKinematics::MaxSpeeds(const world::DriveState& state,
                                                   int steps) const {
  if (drive_.kind == DriveKind::kNone) return {};
  // FollowSpeed() returns a speed between the present speed and the target. The target is zero if
  // the command is too old.
  const auto target = [](double wanted, const model::Range& speed, double max_speed) {
    if (!std::isfinite(wanted)) return 0.0;
    return std::abs(Limited(Limited(wanted, speed.min, speed.max), -max_speed, max_speed));
  };
  const double linear = target(state.command.linear, drive_.linear_velocity, kMaxLinearSpeed);
  Speeds most;
  most.angular = std::max(std::abs(state.actual.angular),
                          target(state.command.angular, drive_.angular_velocity, kMaxAngularSpeed));
  if (can_move_sideways()) {
    // A slide along an obstacle changes the direction of the velocity. After it, FollowSpeed() may
    // raise each component up to that of the target. So each step may add at most the target's
    // squared speed to the squared speed.
    const double lateral = target(state.command.lateral, drive_.linear_velocity, kMaxLinearSpeed);
    const double square = linear * linear + lateral * lateral;
    const world::DriveCommand& now = state.actual;
    const bool follows_at_once = drive_.linear_acceleration.min == -kUnlimited &&
                                 drive_.linear_acceleration.max == kUnlimited;
    const double before = now.linear * now.linear + now.lateral * now.lateral;
    most.linear = std::sqrt(follows_at_once ? std::max(before, square) : before + steps * square);
  } else {
    most.linear = std::max(std::abs(state.actual.linear), linear);
  }
  if (!wheels_are_as_believed_) {
    const double scale = std::max(drive_.left_wheel_scale, drive_.right_wheel_scale);
    const double wheel = scale * (most.linear + most.angular * drive_.wheel_separation / 2);
    most = {wheel, 2 * wheel / drive_.wheel_separation};
  }
  if (slips_) {
    most.linear +=
        drive_.slip.lateral * most.linear * most.linear * most.angular / kStandardGravity;
  }
  most.linear += most.angular * std::abs(reference_x_);
  constexpr double kRounding = 1 + 1e-9;
  return {most.linear * kRounding, most.angular * kRounding};
}

world::DriveCommand DriveKinematics::RolledMotion(const world::DriveCommand& motion) const {
  const double aside = motion.angular * drive_.wheel_separation / 2;
  const double left = (motion.linear - aside) * drive_.left_wheel_scale;
  const double right = (motion.linear + aside) * drive_.right_wheel_scale;
  return {(left + right) / 2, motion.lateral, (right - left) / drive_.wheel_separation};
}

double DriveKinematics::RollOf(const Wheel& wheel, const Travel& travel) const {
  if (wheel.ahead == 0) {
    return wheel.forward * travel.forward + wheel.left * travel.left + wheel.angle * travel.angle;
  }
  const double along = travel.forward + wheel.angle / wheel.forward * travel.angle;
  const double path =
      std::sqrt(along * along + wheel.ahead * wheel.ahead * travel.angle * travel.angle);
  return wheel.forward * std::copysign(path, along);
}

double DriveKinematics::SteeringAngle(const Steered& steered, double curvature) const {
  return steered.sign * std::atan2(drive_.wheel_base * curvature, 1 - steered.lateral * curvature);
}

void DriveKinematics::TurnJoints(const Travel& travel, const world::DriveCommand& motion,
                                 double step_seconds, std::span<double> positions,
                                 std::span<double> velocities) const {
  const world::DriveCommand moves = wheels_are_as_believed_ ? motion : RolledMotion(motion);
  const Travel rolled{travel.forward, travel.left, travel.angle / turn_share_};
  const Travel per_second{moves.linear, moves.lateral, moves.angular};
  for (const Wheel& wheel : wheels_) {
    positions[wheel.joint] += RollOf(wheel, rolled);
    velocities[wheel.joint] = RollOf(wheel, per_second);
  }
  if (drive_.kind != DriveKind::kAckermann) return;
  for (const Steered& steered : steered_) {
    // If the base does not move forwards, its steering angles do not change.
    const double angle = motion.linear == 0
                             ? positions[steered.joint]
                             : SteeringAngle(steered, motion.angular / motion.linear);
    velocities[steered.joint] = (angle - positions[steered.joint]) / step_seconds;
    positions[steered.joint] = angle;
  }
}

}  // namespace gsv::dynamics
