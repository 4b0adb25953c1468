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
  Vector3 size{1, 1, 1};  // lengths of the edges along x, y and z
};
struct Sphere {
  double radius = 0.5;
};
struct Cylinder {
  double radius = 0.5, length = 1;
};
// `length` is the length of the cylindrical part: the whole capsule is length + 2 radius long.
struct Capsule {
  double radius = 0.5, length = 1;
};
struct Ellipsoid {
  Vector3 radii{0.5, 0.5, 0.5};  // half of the extents along x, y and z
};
// The apex points to +z.
struct Cone {
  double radius = 0.5, length = 1;
};
// As a collision shape, this is the half-space below the plane. As a visual, it is a rectangle of
// this size.
struct Plane {
  Vector3 normal{0, 0, 1};  // unit length
  Vector2 size{1, 1};       // lengths of the rectangle's edges
};
// The triangles are shared by their users; the pointer is never null.
struct Mesh {
  std::shared_ptr<const TriangleMesh> triangles;
  Vector3 scale{1, 1, 1};  // factors for the x, y and z coordinates of the triangles
};

using Shape = std::variant<Box, Sphere, Cylinder, Capsule, Ellipsoid, Cone, Plane, Mesh>;

// Returns the surface as triangles with normals and texture coordinates; for a Mesh, a scaled copy.
// Round shapes have `segments` (at least 3) around the axis, with vertices on the true surface. The
// maximum distance from the true surface is radius * (1 - cos(pi / segments)). For doubly curved
// shapes such as spheres, it is twice this value.
TriangleMesh Tessellate(const Shape& shape, int segments = 32);

// Returns the smallest box around the shape along its frame's axes. For a Plane, returns the box of
// its rectangle.
Bounds BoundsOf(const Shape& shape);

}  // namespace gsv::geometry
