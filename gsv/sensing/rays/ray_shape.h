// Intersections of rays with single shapes, in closed form and double precision.
//
// Frames   ray and result are in the shape's frame; distances are along the unit direction.
// Result   the distance to the first crossing of the surface, from outside or inside, within [0,
//          ray.max_distance]; nothing if there is none. A ray that only touches the surface also
//          counts as crossing it. The normal is the surface normal at the first crossing. It has
//          unit length and points against the ray. Call the functions that return a normal only for
//          rays that cross the surface.
#pragma once

#include <optional>

#include "gsv/geometry/shape.h"
#include "gsv/sensing/rays/ray_scene.h"

namespace gsv::sensing {

// A corner, and the two edges from it to the other corners, in the frame of the ray.
struct Triangle {
  geometry::Vector3 corner, edge1, edge2;
};

// Returns the distance, or nullopt if the ray does not cross the triangle.
std::optional<double> DistanceToTriangle(const Ray& ray, const Triangle& triangle);
// Returns the normal of a triangle that the ray crosses.
geometry::Vector3 NormalOfTriangle(const Ray& ray, const Triangle& triangle);

// Returns the distance, or nullopt if the ray does not cross the surface. A Plane is the unbounded
// surface of a half-space. A Mesh is not allowed.
std::optional<double> DistanceToShape(const Ray& ray, const geometry::Shape& shape);
// Returns the normal at the first crossing.
geometry::Vector3 NormalOfShape(const Ray& ray, const geometry::Shape& shape);

}  // namespace gsv::sensing
