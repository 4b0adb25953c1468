// Casts rays against the collision surfaces of a world at one instant. sensing::RayScene implements
// it.
#pragma once

#include <optional>

#include "gsv/geometry/vector3.h"

namespace gsv::world {

// A straight path of limited length.
struct Ray {
  geometry::Vector3 origin;     // world
  geometry::Vector3 direction;  // direction in the world, unit length
  double max_distance = 0;      // m
};

// A point at which a ray crosses a collision surface.
struct Hit {
  double distance = 0;       // distance along the ray, m, in [0, max_distance]
  geometry::Vector3 normal;  // normal in the world, unit length, against the ray
  int body = -1;             // index of the body in the layout
};

// The interface for casting rays.
class RayCaster {
 public:
  virtual ~RayCaster() = default;

  // Returns the nearest point at which the ray crosses a collision surface, from outside or inside.
  // Surfaces of the body `ignored_body` are ignored (-1: none). A ray that starts inside a solid
  // hits the far side of the solid.
  virtual std::optional<Hit> Cast(const Ray& ray, int ignored_body) const = 0;
};

}  // namespace gsv::world
