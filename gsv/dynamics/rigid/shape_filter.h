// Which of Bullet's shapes meet, by the filters of their collisions. Private to this folder.
//
// A shape's user index holds its filter; Bullet's own value for a shape that has none, -1, is the
// filter that meets everything. A compound has the union of its children's.
#pragma once

#include <cstdint>

#include <btBulletCollisionCommon.h>

#include "gsv/model/collision_filter.h"

namespace gsv::dynamics {

inline void SetFilter(btCollisionShape& shape, const model::CollisionFilter& filter) {
  shape.setUserIndex(static_cast<int>(std::uint32_t{filter.category} << 16 | filter.collides));
}

inline bool ShapesMeet(const btCollisionShape* a, const btCollisionShape* b) {
  const auto first = static_cast<std::uint32_t>(a->getUserIndex());
  const auto second = static_cast<std::uint32_t>(b->getUserIndex());
  return ((first >> 16 & second) | (second >> 16 & first & 0xFFFF)) != 0;
}

}  // namespace gsv::dynamics
