// Rotations and rigid transforms.
//
// Frames  REP-103: x forward, y left, z up. A pose named a_from_b transforms points from frame b
//         to frame a, so that a_from_c = a_from_b * b_from_c.
// Units   metres, radians.
#pragma once

#include "gsv/geometry/vector3.h"

namespace gsv::geometry {

// A unit quaternion.
struct Quaternion {
  double w = 1, x = 0, y = 0, z = 0;
  friend bool operator==(const Quaternion&, const Quaternion&) = default;
};

inline Quaternion operator*(const Quaternion& a, const Quaternion& b) {
  return {
      a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z, a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y,
      a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x, a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w};
}
inline Vector3 operator*(const Quaternion& rotation, const Vector3& vector) {
  // v' = v + 2 u × (u × v + w v), with u the vector part and w the scalar part.
  const Vector3 u{rotation.x, rotation.y, rotation.z};
  return vector + 2.0 * Cross(u, Cross(u, vector) + rotation.w * vector);
}
inline Quaternion Inverse(const Quaternion& q) { return {q.w, -q.x, -q.y, -q.z}; }
// Returns the identity for a quaternion of length zero.
inline Quaternion Normalized(const Quaternion& q) {
  const double length = std::sqrt(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z);
  if (!(length > 0)) return {};
  const double s = 1.0 / length;
  return {q.w * s, q.x * s, q.y * s, q.z * s};
}

// Fixed-axis roll, pitch, yaw as in URDF and SDFormat: R = Rz(yaw) Ry(pitch) Rx(roll).
struct RollPitchYaw {
  double roll = 0, pitch = 0, yaw = 0;
};
Quaternion FromRollPitchYaw(const RollPitchYaw& angles);
// The pitch is in [-pi/2, pi/2]; at the ends of this range the roll is 0.
RollPitchYaw ToRollPitchYaw(const Quaternion& q);
// `axis` must have unit length.
Quaternion FromAxisAngle(const Vector3& axis, double angle);
double Yaw(const Quaternion& q);

// A rigid transform: a rotation, followed by a translation.
struct Pose {
  Vector3 position;
  Quaternion orientation;
  friend bool operator==(const Pose&, const Pose&) = default;
};

inline Pose operator*(const Pose& a_from_b, const Pose& b_from_c) {
  return {a_from_b.position + a_from_b.orientation * b_from_c.position,
          a_from_b.orientation * b_from_c.orientation};
}
inline Vector3 operator*(const Pose& a_from_b, const Vector3& point_in_b) {
  return a_from_b.position + a_from_b.orientation * point_in_b;
}
inline Pose Inverse(const Pose& a_from_b) {
  const Quaternion b_from_a = Inverse(a_from_b.orientation);
  return {-(b_from_a * a_from_b.position), b_from_a};
}

// Returns a pose on level ground: at (x, y, z), rotated by `yaw` about z.
Pose PlanarPose(double x, double y, double z, double yaw);

// Returns the equivalent angle in (-pi, pi].
double WrapAngle(double angle);

bool IsFinite(const Vector3& v);
bool IsFinite(const Pose& pose);

}  // namespace gsv::geometry
