// Decides which collisions can collide with each other, by SDFormat's <category_bitmask> and
// <collide_bitmask>.
#pragma once

#include <cstdint>

namespace gsv::model {

struct CollisionFilter {
  std::uint16_t category = 0xFFFF;  // the category of the collision itself
  std::uint16_t collides = 0xFFFF;  // the categories that it collides with
  friend bool operator==(const CollisionFilter&, const CollisionFilter&) = default;
};

// Whether two collisions can collide, as SDFormat 1.9 defines it for <category_bitmask>: `a` must
// collide with the category of `b`, or `b` with the category of `a`.
inline bool Meet(const CollisionFilter& a, const CollisionFilter& b) {
  return ((a.category & b.collides) | (b.category & a.collides)) != 0;
}

// Returns a filter that collides with everything that `a` or `b` collides with.
inline CollisionFilter Union(const CollisionFilter& a, const CollisionFilter& b) {
  return {static_cast<std::uint16_t>(a.category | b.category),
          static_cast<std::uint16_t>(a.collides | b.collides)};
}

// A filter that collides with nothing.
inline constexpr CollisionFilter kMeetsNothing{0, 0};

}  // namespace gsv::model
