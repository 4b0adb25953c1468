// 3x3 matrices in double precision: rotations and inertias.
//
// The order of operations is fixed, so that results are bit-identical on every machine.
#pragma once

#include "gsv/geometry/pose.h"

namespace gsv::dynamics {

// A 3x3 matrix, stored by columns. The columns of a rotation are the axes of the rotated frame.
struct Matrix3 {
  geometry::Vector3 x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};  // the three columns
};

inline geometry::Vector3 operator*(const Matrix3& m, const geometry::Vector3& v) {
  return v.x * m.x + v.y * m.y + v.z * m.z;
}
// The product of the transposed matrix and `v`.
inline geometry::Vector3 TransposeTimes(const Matrix3& m, const geometry::Vector3& v) {
  return {Dot(m.x, v), Dot(m.y, v), Dot(m.z, v)};
}
inline Matrix3 operator*(const Matrix3& a, const Matrix3& b) { return {a * b.x, a * b.y, a * b.z}; }

// Returns the rotation as a matrix.
inline Matrix3 MatrixOf(const geometry::Quaternion& q) {
  const double xx = q.x * q.x, yy = q.y * q.y, zz = q.z * q.z;
  const double xy = q.x * q.y, xz = q.x * q.z, yz = q.y * q.z;
  const double wx = q.w * q.x, wy = q.w * q.y, wz = q.w * q.z;
  return {{1 - 2 * (yy + zz), 2 * (xy + wz), 2 * (xz - wy)},
          {2 * (xy - wz), 1 - 2 * (xx + zz), 2 * (yz + wx)},
          {2 * (xz + wy), 2 * (yz - wx), 1 - 2 * (xx + yy)}};
}

// The symmetric matrix with these principal values along the axes of `rotation`.
inline Matrix3 WithPrincipal(const Matrix3& rotation, const geometry::Vector3& values) {
  const Matrix3 scaled{values.x * rotation.x, values.y * rotation.y, values.z * rotation.z};
  const auto column = [&](double x, double y, double z) {
    return x * scaled.x + y * scaled.y + z * scaled.z;
  };
  return {column(rotation.x.x, rotation.y.x, rotation.z.x),
          column(rotation.x.y, rotation.y.y, rotation.z.y),
          column(rotation.x.z, rotation.y.z, rotation.z.z)};
}

// Returns the rotation by the vector `turn` (rad).
inline geometry::Quaternion RotationBy(const geometry::Vector3& turn) {
  const double angle = Norm(turn);
  // Below this value, sin(x) / x differs from 1 - x² / 6 by less than 1e-15.
  const double scale = angle < 1e-3 ? 0.5 - angle * angle / 48 : std::sin(angle / 2) / angle;
  return {std::cos(angle / 2), scale * turn.x, scale * turn.y, scale * turn.z};
}

// Returns two unit vectors that form a right-handed frame with the unit vector `normal`.
inline void AxesAcross(const geometry::Vector3& normal, geometry::Vector3& first,
                       geometry::Vector3& second) {
  if (std::abs(normal.z) > 0.70710678118654757) {
    first = Normalized(geometry::Vector3{0, -normal.z, normal.y});
  } else {
    first = Normalized(geometry::Vector3{-normal.y, normal.x, 0});
  }
  second = Cross(normal, first);
}

}  // namespace gsv::dynamics
