#include "gsv/geometry/pose.h"

#include <algorithm>
#include <numbers>

namespace gsv::geometry {

Quaternion FromAxisAngle(const Vector3& axis, double angle) {
  const double s = std::sin(angle / 2);
  return {std::cos(angle / 2), axis.x * s, axis.y * s, axis.z * s};
}

Quaternion FromRollPitchYaw(const RollPitchYaw& angles) {
  return FromAxisAngle({0, 0, 1}, angles.yaw) * FromAxisAngle({0, 1, 0}, angles.pitch) *
         FromAxisAngle({1, 0, 0}, angles.roll);
}

RollPitchYaw ToRollPitchYaw(const Quaternion& q) {
  const double sin_pitch = std::clamp(2 * (q.w * q.y - q.z * q.x), -1.0, 1.0);
  if (std::abs(sin_pitch) > 1.0 - 1e-12) {
    // In gimbal lock, only yaw - roll (or yaw + roll) is determined, so the roll is set to 0.
    const double yaw = std::atan2(-2 * (q.x * q.y - q.w * q.z), 1 - 2 * (q.x * q.x + q.z * q.z));
    return {0.0, std::copysign(std::numbers::pi / 2, sin_pitch), yaw};
  }
  return {std::atan2(2 * (q.w * q.x + q.y * q.z), 1 - 2 * (q.x * q.x + q.y * q.y)),
          std::asin(sin_pitch), Yaw(q)};
}

double Yaw(const Quaternion& q) {
  return std::atan2(2 * (q.w * q.z + q.x * q.y), 1 - 2 * (q.y * q.y + q.z * q.z));
}

Pose PlanarPose(double x, double y, double z, double yaw) {
  return {{x, y, z}, FromAxisAngle({0, 0, 1}, yaw)};
}

double WrapAngle(double angle) {
  const double wrapped = std::remainder(angle, 2 * std::numbers::pi);
  return wrapped <= -std::numbers::pi ? wrapped + 2 * std::numbers::pi : wrapped;
}

bool IsFinite(const Vector3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

bool IsFinite(const Pose& pose) {
  const Quaternion& q = pose.orientation;
  return IsFinite(pose.position) && std::isfinite(q.w) && IsFinite(Vector3{q.x, q.y, q.z});
}

}  // namespace gsv::geometry
