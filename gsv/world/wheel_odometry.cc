#include "gsv/world/wheel_odometry.h"

#include <algorithm>

namespace gsv::world {

void WheelOdometry::SetLayout(const Layout& layout) {
  bases_.clear();
  base_of_.assign(layout.bodies.size(), -1);
  wheels_.clear();
  for (std::size_t i = 0; i < layout.bodies.size(); ++i) {
    const Body& body = layout.bodies[i];
    if (!body.is_robot() || !body.model->drive) continue;
    const model::Drive& drive = *body.model->drive;
    const auto add = [&](const std::vector<int>& joints) {
      for (const int joint : joints) {
        const model::Joint& axle = body.model->joints[static_cast<std::size_t>(joint)];
        // A positive rotation rolls the wheel forwards only if its axle points to the left.
        const bool backwards = (axle.model_from_joint.orientation * axle.axis).y < 0;
        const double radius = backwards ? -drive.wheel_radius : drive.wheel_radius;
        wheels_.push_back({body.first_joint + joint, radius / static_cast<double>(joints.size())});
      }
    };
    const auto next_wheel = [&] { return static_cast<std::uint32_t>(wheels_.size()); };
    Base base;
    base.body = static_cast<int>(i);
    base.separation = drive.wheel_separation;
    base.left_wheel = base.right_wheel = base.end_wheel = next_wheel();
    if (drive.kind == model::DriveKind::kDifferential && !drive.left_wheels.empty() &&
        !drive.right_wheels.empty()) {
      add(drive.left_wheels);
      base.right_wheel = next_wheel();
      add(drive.right_wheels);
      base.end_wheel = next_wheel();
    }
    base_of_[i] = static_cast<int>(bases_.size());
    bases_.push_back(base);
  }
}

double WheelOdometry::Travel(std::uint32_t begin, std::uint32_t end, const State& state) const {
  double travel = 0;
  for (std::uint32_t i = begin; i < end; ++i) {
    const Wheel& wheel = wheels_[i];
    travel += wheel.metres_per_rad * (state.joint_positions[wheel.joint] - before_[wheel.joint]);
  }
  return travel;
}

[[gnu::always_inline]] inline void WheelOdometry::AdvanceBase(double step_seconds, const Base& base,
                                                              int steps, State& state) const {
  BodyState& body = state.bodies[base.body];
  double forward = 0, left = 0, angle = 0;
  if (base.left_wheel == base.end_wheel) {
    forward = step_seconds * body.drive.actual.linear;
    left = step_seconds * body.drive.actual.lateral;
    angle = step_seconds * body.drive.actual.angular;
  } else {
    const double on_left = Travel(base.left_wheel, base.right_wheel, state);
    const double on_right = Travel(base.right_wheel, base.end_wheel, state);
    forward = (on_left + on_right) / 2;
    angle = (on_right - on_left) / base.separation;
  }
  Odometry& odometry = body.odometry;
  odometry.linear = forward / step_seconds;
  odometry.angular = angle / step_seconds;
  if (forward == 0 && left == 0 && angle == 0) return;
  for (int i = 0; i < steps; ++i) {
    odometry.place = geometry::Advance(odometry.place, {forward, left, angle}, 1);
    odometry.place.Normalize();
  }
}

void WheelOdometry::Advance(double step_seconds, std::size_t begin, std::size_t end,
                            State& state) const {
  const auto first =
      std::lower_bound(bases_.begin(), bases_.end(), begin, [](const Base& base, std::size_t body) {
        return static_cast<std::size_t>(base.body) < body;
      });
  for (auto at = first; at != bases_.end() && static_cast<std::size_t>(at->body) < end; ++at) {
    AdvanceBase(step_seconds, *at, 1, state);
  }
}

[[gnu::flatten]] void WheelOdometry::AdvanceBody(double step_seconds, int body, int steps,
                                                 State& state) {
  const int index = base_of_[static_cast<std::size_t>(body)];
  if (index < 0) return;
  const Base& base = bases_[static_cast<std::size_t>(index)];
  AdvanceBase(step_seconds, base, steps, state);
  for (std::uint32_t i = base.left_wheel; i < base.end_wheel; ++i) {
    const auto joint = static_cast<std::size_t>(wheels_[i].joint);
    before_[joint] = state.joint_positions[joint];
  }
}

}  // namespace gsv::world
