// The shapes of visuals and collisions, each in its own frame.
//
// Units  metres. Axes of cylinder, capsule and cone run along z; every shape is centred on its
//        frame's origin, as in SDFormat.
#pragma once

#include <memory>
#include <variant>

#include "gsv/geometry/pose.h"
#include "gsv/geometry/triangle_mesh.h"

namespace gsv::geometry {

struct Box {
  Vector3 size{1, 1, 1};
};
struct Sphere {
  double radius = 0.5;
};
struct Cylinder {
  double radius = 0.5, length = 1;
};
// `length` is that of the cylindrical part: the whole is length + 2 radius long.
struct Capsule {
  double radius = 0.5, length = 1;
};
struct Ellipsoid {
  Vector3 radii{0.5, 0.5, 0.5};
};
// The apex points to +z.
struct Cone {
  double radius = 0.5, length = 1;
};
// To collide with, a half-space that ends at the plane; to look at, a rectangle of this size.
struct Plane {
  Vector3 normal{0, 0, 1};  // unit length
  Vector2 size{1, 1};
};
// Shared between all who use it; never null.
struct Mesh {
  std::shared_ptr<const TriangleMesh> triangles;
  Vector3 scale{1, 1, 1};
};

using Shape = std::variant<Box, Sphere, Cylinder, Capsule, Ellipsoid, Cone, Plane, Mesh>;

// The surface as triangles with normals and texture coordinates; of a Mesh its scaled copy. Round
// shapes take `segments` (at least 3) around, their vertices lie on the true surface, and the
// triangles stay within radius * (1 - cos(pi / segments)) of it, twice that where the surface
// curves both ways.
TriangleMesh Tessellate(const Shape& shape, int segments = 32);

// The smallest box around the shape, its axes along the shape's frame. Of a Plane: its rectangle.
Bounds BoundsOf(const Shape& shape);

}  // namespace gsv::geometry
