// A few rays that start near one place, as a structure of arrays, so that they are computed
// together.
#pragma once

#include <array>
#include <cstddef>

#include "gsv/world/ray_caster.h"

namespace gsv::sensing {

// A packet of rays, of which `count` are used.
struct RayPacket {
  static constexpr std::size_t kMax = 8;
  using Coordinates = std::array<double, kMax>;

  std::size_t count = 0;
  alignas(32) Coordinates origin_x{}, origin_y{}, origin_z{};           // in the world, m
  alignas(32) Coordinates direction_x{}, direction_y{}, direction_z{};  // in the world, unit length
  alignas(32) Coordinates max_distance{};                               // m

  // Adds a ray. The packet must have space for it.
  void Add(const world::Ray& ray) {
    origin_x[count] = ray.origin.x, origin_y[count] = ray.origin.y, origin_z[count] = ray.origin.z;
    direction_x[count] = ray.direction.x, direction_y[count] = ray.direction.y;
    direction_z[count] = ray.direction.z;
    max_distance[count++] = ray.max_distance;
  }
  // Returns ray i.
  world::Ray At(std::size_t i) const {
    return {{origin_x[i], origin_y[i], origin_z[i]},
            {direction_x[i], direction_y[i], direction_z[i]},
            max_distance[i]};
  }
};

}  // namespace gsv::sensing
