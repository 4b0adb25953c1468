// Volume, centroid and second moments of solid shapes.
//
// Source  Closed forms are from textbooks. The moments of a mesh follow from the divergence
//         theorem: each triangle and a common point form a tetrahedron, and the moments of these
//         are added.
#pragma once

#include "gsv/geometry/shape.h"

namespace gsv::geometry {

// The volume of a shape in m³, its centroid in m, and its second moments in m⁵. `xx` is the
// integral of (x - centroid.x)² over the volume, `xy` is the integral of (x - centroid.x)(y -
// centroid.y), and so on.
struct SolidMoments {
  double volume = 0;
  Vector3 centroid;
  double xx = 0, yy = 0, zz = 0, xy = 0, xz = 0, yz = 0;
};

// Returns the moments in the shape's frame. A plane has no volume. A mesh must be closed, because
// the result for an open mesh depends on the position of its first vertex. The normals of a mesh
// may point inwards.
SolidMoments MomentsOf(const Shape& shape);

// The part of a closed mesh below the plane z = `height` in the world: its volume, and the integral
// of the position over it. The result is exact. The cut face needs no triangles: tetrahedra between
// the cut face and a point of the plane would have no volume.
struct VolumeBelow {
  double volume = 0;     // m³
  Vector3 first_moment;  // m⁴, in the world
};
VolumeBelow BelowHeight(const TriangleMesh& mesh, const Pose& world_from_mesh, double height);

// Returns the part of a sphere below the plane, which is a cap, in closed form.
VolumeBelow SphereBelowHeight(double radius, const Vector3& centre_in_world, double height);

}  // namespace gsv::geometry
