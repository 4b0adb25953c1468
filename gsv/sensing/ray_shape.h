// Rays against single shapes, in closed form and double precision.
//
// Frames   ray and result are in the shape's frame; distances are along the unit direction.
// Result   the first crossing of the surface, from outside or inside, at a distance in
//          [0, ray.max_distance]; the normal has unit length and points against the ray. A touch
//          counts as a crossing. Without a crossing nothing.
#pragma once

#include <optional>

#include "gsv/geometry/shape.h"
#include "gsv/sensing/ray_scene.h"

namespace gsv::sensing {

struct SurfaceHit {
  double distance = 0;
  geometry::Vector3 normal;
};

// A corner and the two edges that leave it.
struct Triangle {
  geometry::Vector3 corner, edge1, edge2;
};

std::optional<SurfaceHit> CastAtTriangle(const Ray& ray, const Triangle& triangle);

// A Plane is a half-space's surface, without end; a Mesh is not for this function.
std::optional<SurfaceHit> CastAtShape(const Ray& ray, const geometry::Shape& shape);

}  // namespace gsv::sensing
