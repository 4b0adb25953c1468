// Computes the distance of a point from the surface of a shape.
#pragma once

#include "gsv/geometry/shape.h"

namespace gsv::geometry {

// The distance from a point, in the shape's frame, to the shape's surface in metres: negative
// inside a solid and below a Plane. A Mesh has no inside, so the distance is never negative. It is
// infinite if the mesh has no triangles. The result is exact for all shapes except an Ellipsoid.
// For an Ellipsoid, it is exact to first order near the surface, and its sign is right everywhere.
//
// Sources  triangles: Ericson, Real-Time Collision Detection (2005), 5.1.5; ellipsoid: the value
//          of the implicit function divided by the length of its gradient (Taubin 1994).
double DistanceTo(const Shape& shape, const Vector3& point);

}  // namespace gsv::geometry
