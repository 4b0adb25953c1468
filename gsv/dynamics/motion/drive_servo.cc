#include "gsv/dynamics/motion/drive_servo.h"

#include <algorithm>
#include <cmath>

namespace gsv::dynamics {

using geometry::Vector3;

void HoldBase(const DriveServo& servo, const geometry::Pose& world_from_model, const Vector3& point,
              double grip, double seconds, Vector3& velocity_of_point, Vector3& angular_velocity) {
  const geometry::Twist twist = servo.kinematics().OriginTwist(servo.motion());
  const double yaw = geometry::Yaw(world_from_model.orientation);
  const Vector3 arm = point - world_from_model.position;
  const double wanted_x = std::cos(yaw) * twist.x - std::sin(yaw) * twist.y - twist.angular * arm.y;
  const double wanted_y = std::sin(yaw) * twist.x + std::cos(yaw) * twist.y + twist.angular * arm.x;
  const double most = grip * seconds;
  const double missing_x = wanted_x - velocity_of_point.x;
  const double missing_y = wanted_y - velocity_of_point.y;
  // The limit applies to the length of the change of velocity, so it is the same in every
  // direction.
  const double missing = std::sqrt(missing_x * missing_x + missing_y * missing_y);
  const double share = missing > most ? most / missing : 1;
  velocity_of_point.x += share * missing_x;
  velocity_of_point.y += share * missing_y;
  angular_velocity.z += std::clamp(twist.angular - angular_velocity.z, -most, most);
}

bool RollsOnWheels(const model::Model& model) {
  return model.drive && !model.drive->left_wheels.empty() &&
         (model.drive->kind == model::DriveKind::kDifferential ||
          model.drive->kind == model::DriveKind::kAckermann);
}

}  // namespace gsv::dynamics
