// Convex pieces of the plane with round corners, and the distance between two of them. Footprints
// and slices of obstacles consist of such pieces.
//
// Units  metres. Both pieces of a pair are given in one frame.
#pragma once

#include <array>
#include <functional>
#include <span>
#include <vector>

#include "gsv/geometry/vector3.h"

namespace gsv::dynamics {

using geometry::Vector2;

// All points within `radius` of the convex hull of the vertices. One vertex gives a disc, two give
// a segment or stadium, more give a polygon.
struct ConvexPiece {
  static constexpr int kMaxVertices = 16;

  double radius = 0;                           // m
  int vertex_count = 0;                        // at least 1
  std::array<Vector2, kMaxVertices> vertices;  // counter-clockwise, strictly convex

  std::span<const Vector2> points() const { return {vertices.data(), std::size_t(vertex_count)}; }
};

// Returns the piece of all points within `radius` of the centre.
ConvexPiece Disc(Vector2 centre, double radius);

// Returns the hull of at least one point. If it would have more than kMaxVertices corners, returns
// the smallest polygon around it whose edges have kMaxVertices evenly spread directions.
ConvexPiece Hull(std::vector<Vector2> points);

// Returns the smallest polygon that contains a shape, with at most kMaxVertices edges in fixed
// directions. The outward normals of the edges have the angles (rad) `angle` + 2π k / kMaxVertices.
// `support` returns the extent of the shape along a unit vector. If the shape is a polygon whose
// edges have these normals, the result is exact.
ConvexPiece PolygonAround(const std::function<double(Vector2)>& support, double angle);

// The piece, rotated by the angle with the given cosine and sine, then translated.
void Place(const ConvexPiece& piece, double x, double y, double cosine, double sine,
           ConvexPiece& placed);

// The distance or overlap of two pieces.
struct Separation {
  double distance = 0;  // negative if they overlap: the depth along the normal
  Vector2 normal;       // unit length, from the first piece to the second
  Vector2 point;        // the point at which they are closest, halfway between them
};

// Computes the separation of two pieces in one frame.
Separation Separate(const ConvexPiece& a, const ConvexPiece& b);

// Returns the distance from a point to the nearest point of the piece; 0 inside its polygon.
double DistanceTo(const ConvexPiece& piece, Vector2 point);

// Whether every point of `inner` lies in `outer` (within `tolerance`). If `outer` has both corners
// and a radius, the result may be wrongly false, but never wrongly true.
bool Contains(const ConvexPiece& outer, const ConvexPiece& inner, double tolerance);

// The smallest circle that contains the piece and has its centre at the mean of the vertices.
ConvexPiece BoundingDisc(const ConvexPiece& piece);

inline double Dot(Vector2 a, Vector2 b) { return a.x * b.x + a.y * b.y; }
inline double Cross(Vector2 a, Vector2 b) { return a.x * b.y - a.y * b.x; }

}  // namespace gsv::dynamics
