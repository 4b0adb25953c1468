// Which collisions can collide with each other: SDFormat's <category_bitmask> and <collide_bitmask>.
#pragma once

#include <cstdint>

namespace gsv::model {

struct CollisionFilter {
  std::uint16_t category = 0xFFFF;  // of the collision itself
  std::uint16_t collides = 0xFFFF;  // the categories that it meets
  friend bool operator==(const CollisionFilter&, const CollisionFilter&) = default;
};

// Whether two collisions meet, as SDFormat 1.9 defines it for <category_bitmask>: one of them is
// enough to want it.
inline bool Meet(const CollisionFilter& a, const CollisionFilter& b) {
  return ((a.category & b.collides) | (b.category & a.collides)) != 0;
}

// Meets whatever one of the two meets.
inline CollisionFilter Union(const CollisionFilter& a, const CollisionFilter& b) {
  return {static_cast<std::uint16_t>(a.category | b.category),
          static_cast<std::uint16_t>(a.collides | b.collides)};
}

// Meets nothing.
inline constexpr CollisionFilter kMeetsNothing{0, 0};

}  // namespace gsv::model
