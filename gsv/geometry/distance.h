// Computes the distance of a point from the surface of a shape.
#pragma once

#include "gsv/geometry/shape.h"

namespace gsv::geometry {

// The distance from a point, in the shape's frame, to the shape's surface in metres: negative
// inside a solid and below a Plane. A Mesh has no inside: its distance is never negative, and
// infinite without triangles. The result is exact except for an Ellipsoid, where it is exact to
// first order near the surface and has the right sign everywhere.
//
// Sources  triangles: Ericson, Real-Time Collision Detection (2005), 5.1.5; ellipsoid: the value
//          of the implicit function divided by the length of its gradient (Taubin 1994).
double DistanceTo(const Shape& shape, const Vector3& point);

}  // namespace gsv::geometry
