// Casts rays against the collision surfaces of a world at one instant. sensing::RayScene implements
// it.
#pragma once

#include <optional>

#include "gsv/geometry/vector3.h"

namespace gsv::world {

struct Ray {
  geometry::Vector3 origin;     // world
  geometry::Vector3 direction;  // world, unit length
  double max_distance = 0;      // m
};

struct Hit {
  double distance = 0;       // m along the ray, in [0, max_distance]
  geometry::Vector3 normal;  // world, unit length, against the ray
  int body = -1;             // index in the layout
};

class RayCaster {
 public:
  virtual ~RayCaster() = default;

  // The nearest collision surface, entered or left, that is not of the body `ignored_body` (-1: of
  // any). A ray that starts inside a solid hits the far side.
  virtual std::optional<Hit> Cast(const Ray& ray, int ignored_body) const = 0;
};

}  // namespace gsv::world
