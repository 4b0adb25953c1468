// Converts GSV's vectors and poses to Bullet's types, and back.
#pragma once

#include <btBulletDynamicsCommon.h>

#include "gsv/geometry/pose.h"

namespace gsv::dynamics {

inline btVector3 ToBullet(const geometry::Vector3& v) { return {v.x, v.y, v.z}; }
inline geometry::Vector3 FromBullet(const btVector3& v) { return {v.x(), v.y(), v.z()}; }

inline btQuaternion ToBullet(const geometry::Quaternion& q) { return {q.x, q.y, q.z, q.w}; }
inline geometry::Quaternion FromBullet(const btQuaternion& q) {
  return geometry::Normalized({q.w(), q.x(), q.y(), q.z()});
}

inline btTransform ToBullet(const geometry::Pose& pose) {
  return btTransform(ToBullet(pose.orientation), ToBullet(pose.position));
}
inline geometry::Pose FromBullet(const btTransform& t) {
  return {FromBullet(t.getOrigin()), FromBullet(t.getRotation())};
}

}  // namespace gsv::dynamics
