// A piece of a solid at its present pose, and the points at which two pieces touch.
#pragma once

#include <array>
#include <vector>

#include "gsv/dynamics/rigid/rigid_body.h"

namespace gsv::dynamics {

// A piece of a solid with its pose and bounding box in the world.
struct PlacedPiece {
  const Piece* piece = nullptr;  // never null
  geometry::Vector3 position;    // origin of the piece's frame, in the world
  Matrix3 rotation;              // axes of the piece's frame, in the world
  geometry::Vector3 low, high;   // bounding box along the axes of the world
};

// Places the piece for a solid at `position` with these axes.
PlacedPiece Place(const Piece& piece, const geometry::Vector3& position, const Matrix3& rotation);

// Computes the bounding box.
void SetBoundsOf(PlacedPiece& placed);

// A point at which two pieces touch, or may touch soon.
struct TouchPoint {
  geometry::Vector3 on_second;  // the point on the second piece, in the world, m
  geometry::Vector3 normal;     // unit length, in the world, from the second piece to the first
  double distance = 0;          // m, negative if they overlap
};

// Adds the points at which two pieces are closer than `margin`, in closed form. Returns false if
// there is no closed form for this pair of kinds.
//
// Sphere and capsule  one point, or one at each end. A sphere on triangles: see TriangleSurface.
// Cylinder            on a plane: the lowest point of both rims, or four points of the rim on which
//                     it stands. On triangles: see TriangleSurface.
// Box                 on a plane: its corners. On a box: the corners of the area that both faces
//                     share, at most four, or the point at which two edges cross.
bool AddTouchPoints(const PlacedPiece& first, const PlacedPiece& second, double margin,
                    std::vector<TouchPoint>& points);

// Computes the points of a cylinder that are nearest to a plane below it: the lowest point of both
// rims, or four points of the rim on which it stands. The results are vectors from the cylinder's
// centre. Returns the number of points.
int LowestOfCylinder(const PlacedPiece& cylinder, const geometry::Vector3& normal,
                     std::array<geometry::Vector3, 4>& lowest);

// Implements AddTouchPoints() for two boxes.
void AddBoxPoints(const PlacedPiece& first, const PlacedPiece& second, double margin,
                  std::vector<TouchPoint>& points);

}  // namespace gsv::dynamics
