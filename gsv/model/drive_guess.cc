#include "gsv/model/drive_guess.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "gsv/model/wheels.h"

namespace gsv::model {
namespace {

using geometry::Vector3;

constexpr double kAcross = 0.9;  // minimum cosine between an axle and the model's y axis
// Wheels whose radius is below this fraction of the largest wheel's radius are not driven.
constexpr double kIdlerRadius = 0.8;
// The half track is half the distance between the outermost left and right wheels. A wheel is a
// caster if its distance from the robot's middle line is below this fraction of the half track.
constexpr double kMiddle = 0.25;
constexpr double kNarrowest = 0.01;  // m: minimum half track of a drive
// Minimum distance of a caster behind its swivel joint, as a fraction of the wheel's radius.
constexpr double kTrail = 0.15;
constexpr double kMaxSteeringAngle = 1.4;  // rad: maximum of a measured steering limit
constexpr double kFullTurn = 6.2;          // rad: a swivel joint with a smaller range has limits

const Joint& JointAt(const Model& model, int joint) {
  return model.joints[static_cast<std::size_t>(joint)];
}

double Width(const Range& range) { return range.max - range.min; }

// Returns the horizontal distance from the swivel joint to the wheel, perpendicular to the axle.
double Trail(const Model& model, const Wheel& wheel) {
  const Vector3 arm = wheel.centre - JointAt(model, *wheel.swivel).model_from_joint.position;
  const Vector3 forward = Normalized(Cross(wheel.axis, {0, 0, 1}));
  return std::abs(Dot(arm, forward));
}

std::set<std::string> CommandedJoints(const Model& model) {
  std::set<std::string> joints;
  for (const ControlSystem& system : model.control_systems) {
    for (const JointInterfaces& each : system.joints) {
      if (!each.command.empty()) joints.insert(each.joint);
    }
  }
  return joints;
}

struct Sorted {
  std::vector<Wheel> fixed, steered;
};

Sorted Sort(const Model& model) {
  Sorted sorted;
  std::vector<Wheel> turning;  // wheels that can turn all the way about their swivel
  for (const Wheel& wheel : FindWheels(model)) {
    if (std::abs(wheel.axis.y) < kAcross) continue;
    const bool is_limited = wheel.swivel && !TurnsFreely(JointAt(model, *wheel.swivel)) &&
                            Width(JointAt(model, *wheel.swivel).position_limits) < kFullTurn;
    if (!wheel.swivel || is_limited) {
      if (IsNamed(model, wheel, {"caster", "castor"})) continue;
      (is_limited ? sorted.steered : sorted.fixed).push_back(wheel);
    } else if (IsNamed(model, wheel, {"steer"}) || Trail(model, wheel) < kTrail * wheel.radius) {
      turning.push_back(wheel);
    }
  }
  const bool can_steer = sorted.fixed.empty() || !sorted.steered.empty() ||
                         std::any_of(turning.begin(), turning.end(), [&](const Wheel& wheel) {
                           return IsNamed(model, wheel, {"steer"});
                         });
  if (can_steer) sorted.steered.insert(sorted.steered.end(), turning.begin(), turning.end());
  return sorted;
}

void KeepDriven(const Model& model, std::vector<Wheel>& wheels) {
  double largest = 0;
  for (const Wheel& wheel : wheels) largest = std::max(largest, wheel.radius);
  std::erase_if(wheels,
                [&](const Wheel& w) { return w.radius > 0 && w.radius < kIdlerRadius * largest; });
  const std::set<std::string> commanded = CommandedJoints(model);
  const auto is_commanded = [&](const Wheel& wheel) {
    return commanded.contains(JointAt(model, wheel.joint).name);
  };
  if (std::any_of(wheels.begin(), wheels.end(), is_commanded)) {
    std::erase_if(wheels, [&](const Wheel& wheel) { return !is_commanded(wheel); });
  }
}

// Adds the left and the right wheels to the drive. Left and right are relative to the middle
// between the two outermost wheels.
bool AddSides(const std::vector<Wheel>& wheels, Drive& drive) {
  if (wheels.empty()) return false;
  const auto [right, left] =
      std::minmax_element(wheels.begin(), wheels.end(),
                          [](const Wheel& a, const Wheel& b) { return a.centre.y < b.centre.y; });
  const double middle = (left->centre.y + right->centre.y) / 2;
  const double half = (left->centre.y - right->centre.y) / 2;
  if (half < kNarrowest) return false;
  for (const Wheel& wheel : wheels) {
    const double aside = wheel.centre.y - middle;
    if (aside > kMiddle * half) drive.left_wheels.push_back(wheel.joint);
    if (aside < -kMiddle * half) drive.right_wheels.push_back(wheel.joint);
  }
  return true;
}

// Whether the wheel is a mecanum wheel: its rollers are at 45°, so friction is small along a
// diagonal.
bool HasDiagonalRollers(const Model& model, const Wheel& wheel) {
  if (IsNamed(model, wheel, {"mecanum"})) return true;
  const Link& link = model.links[static_cast<std::size_t>(JointAt(model, wheel.joint).child)];
  return std::any_of(link.collisions.begin(), link.collisions.end(), [](const Collision& each) {
    const Vector3& direction = each.surface.friction_direction;
    const double a = std::abs(direction.x), b = std::abs(direction.y), c = std::abs(direction.z);
    const double first = std::max({a, b, c});
    const double second = a + b + c - first - std::min({a, b, c});
    return first > 0 && second > 0.7 * first && each.surface.friction != each.surface.friction2;
  });
}

void AddSteering(const std::vector<Wheel>& fixed, const std::vector<Wheel>& steered, Drive& drive) {
  std::set<int> swivels;
  for (const Wheel& wheel : steered) swivels.insert(*wheel.swivel);
  drive.steered.assign(swivels.begin(), swivels.end());
  double foremost = -std::numeric_limits<double>::infinity();
  for (const Wheel& wheel : fixed) foremost = std::max(foremost, wheel.centre.x);
  const bool all_in_front = std::all_of(steered.begin(), steered.end(), [&](const Wheel& wheel) {
    return wheel.centre.x > foremost + wheel.radius / 2;
  });
  if (!all_in_front) return;
  drive.kind = DriveKind::kAckermann;
  Drive front;
  if (AddSides(steered, front)) {
    for (const int joint : front.left_wheels) drive.left_wheels.push_back(joint);
    for (const int joint : front.right_wheels) drive.right_wheels.push_back(joint);
  }
}

Vector3 CentreOf(const Model& model, int joint) {
  const auto wheel = MeasureWheel(model, joint);
  return wheel ? wheel->centre : JointAt(model, joint).model_from_joint.position;
}

double MeanY(const Model& model, const std::vector<int>& joints) {
  double sum = 0;
  for (const int joint : joints) sum += CentreOf(model, joint).y;
  return sum / static_cast<double>(joints.size());
}

void MeasureSteering(const Model& model, Drive& drive) {
  if (drive.steered.empty()) return;
  // The wheel base is defined as the distance from the rearmost wheel's joint to the steering
  // joints.
  double rear = std::numeric_limits<double>::infinity();
  for (const auto* wheels : {&drive.left_wheels, &drive.right_wheels}) {
    for (const int joint : *wheels) {
      rear = std::min(rear, JointAt(model, joint).model_from_joint.position.x);
    }
  }
  double sum = 0;
  double limit = kMaxSteeringAngle;
  bool is_limited = false;
  for (const int joint : drive.steered) {
    const Joint& steered = JointAt(model, joint);
    sum += steered.model_from_joint.position.x;
    const double most =
        std::min(std::abs(steered.position_limits.min), std::abs(steered.position_limits.max));
    if (!std::isfinite(most) || most < 0.01) continue;
    limit = std::min(limit, most);
    is_limited = true;
  }
  const double base = sum / static_cast<double>(drive.steered.size()) - rear;
  if (std::isfinite(base) && base > 0) drive.wheel_base = base;
  if (is_limited) drive.steering_limit = limit;
}

void MeasureLength(const Model& model, Drive& drive) {
  double front = -std::numeric_limits<double>::infinity();
  double rear = std::numeric_limits<double>::infinity();
  for (const auto* wheels : {&drive.left_wheels, &drive.right_wheels}) {
    for (const int joint : *wheels) {
      front = std::max(front, CentreOf(model, joint).x);
      rear = std::min(rear, CentreOf(model, joint).x);
    }
  }
  if (front > rear) drive.wheel_base = front - rear;
}

}  // namespace

void MeasureDrive(const Model& model, Drive& drive) {
  if (drive.left_wheels.empty() || drive.right_wheels.empty()) return;
  const double apart = MeanY(model, drive.left_wheels) - MeanY(model, drive.right_wheels);
  if (std::abs(apart) > 0) drive.wheel_separation = std::abs(apart);
  for (const auto* wheels : {&drive.right_wheels, &drive.left_wheels}) {
    for (auto joint = wheels->rbegin(); joint != wheels->rend(); ++joint) {
      const auto wheel = MeasureWheel(model, *joint);
      if (wheel) drive.wheel_radius = wheel->radius;
    }
  }
  if (drive.kind == DriveKind::kAckermann) {
    MeasureSteering(model, drive);
  } else {
    MeasureLength(model, drive);
  }
}

Drive GuessDrive(const Model& model) {
  Drive none;
  none.kind = DriveKind::kNone;
  none.origin = DriveOrigin::kGuessed;
  Drive drive;
  drive.origin = DriveOrigin::kGuessed;
  Sorted wheels = Sort(model);
  KeepDriven(model, wheels.fixed);
  if (!AddSides(wheels.fixed, drive) || drive.left_wheels.empty() || drive.right_wheels.empty()) {
    if (wheels.steered.size() < 3) return none;
    none.kind = DriveKind::kVelocity;
    return none;
  }
  if (!wheels.steered.empty()) {
    AddSteering(wheels.fixed, wheels.steered, drive);
  } else if (wheels.fixed.size() == 4 &&
             std::all_of(wheels.fixed.begin(), wheels.fixed.end(),
                         [&](const Wheel& w) { return HasDiagonalRollers(model, w); })) {
    drive.kind = DriveKind::kMecanum;
  }
  MeasureDrive(model, drive);
  const bool can_steer = drive.kind != DriveKind::kAckermann || drive.wheel_base > 0;
  return can_steer ? drive : none;
}

}  // namespace gsv::model
