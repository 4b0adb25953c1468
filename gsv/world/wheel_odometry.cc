#include "gsv/world/wheel_odometry.h"

namespace gsv::world {

void WheelOdometry::SetLayout(const Layout& layout) {
  bases_.clear();
  for (std::size_t i = 0; i < layout.bodies.size(); ++i) {
    const Body& body = layout.bodies[i];
    if (!body.is_robot() || !body.model->drive) continue;
    const model::Drive& drive = *body.model->drive;
    Base base;
    base.body = static_cast<int>(i);
    base.separation = drive.wheel_separation;
    const auto add = [&](const std::vector<int>& joints, std::vector<Wheel>& wheels) {
      for (const int joint : joints) {
        const model::Joint& axle = body.model->joints[static_cast<std::size_t>(joint)];
        // If the axle points to the left, a positive rotation rolls the wheel forwards.
        const bool backwards = (axle.model_from_joint.orientation * axle.axis).y < 0;
        const double radius = backwards ? -drive.wheel_radius : drive.wheel_radius;
        wheels.push_back({body.first_joint + joint, radius / static_cast<double>(joints.size())});
      }
    };
    if (drive.kind == model::DriveKind::kDifferential && !drive.left_wheels.empty() &&
        !drive.right_wheels.empty()) {
      add(drive.left_wheels, base.left);
      add(drive.right_wheels, base.right);
    }
    bases_.push_back(std::move(base));
  }
}

double WheelOdometry::Travel(const std::vector<Wheel>& wheels, const State& state) const {
  double travel = 0;
  for (const Wheel& wheel : wheels) {
    travel += wheel.metres_per_rad * (state.joint_positions[wheel.joint] - before_[wheel.joint]);
  }
  return travel;
}

void WheelOdometry::Advance(double step_seconds, State& state) const {
  for (const Base& base : bases_) {
    BodyState& body = state.bodies[base.body];
    double forward = 0, left = 0, angle = 0;
    if (base.left.empty()) {
      forward = step_seconds * body.drive.actual.linear;
      left = step_seconds * body.drive.actual.lateral;
      angle = step_seconds * body.drive.actual.angular;
    } else {
      const double on_left = Travel(base.left, state), on_right = Travel(base.right, state);
      forward = (on_left + on_right) / 2;
      angle = (on_right - on_left) / base.separation;
    }
    Odometry& odometry = body.odometry;
    odometry.linear = forward / step_seconds;
    odometry.angular = angle / step_seconds;
    if (forward == 0 && left == 0 && angle == 0) continue;
    odometry.place = geometry::Advance(odometry.place, {forward, left, angle}, 1);
    odometry.place.Normalize();
  }
}

}  // namespace gsv::world
