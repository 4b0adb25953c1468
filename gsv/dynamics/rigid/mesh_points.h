// The points at which one piece touches a mesh.
#pragma once

#include <cstddef>
#include <vector>

#include "gsv/dynamics/rigid/placed_piece.h"

namespace gsv::dynamics {

// Collects the points at which a piece touches a mesh, in the mesh's frame, and removes redundant
// points.
//
// Fine meshes  For a wheel with a radius of 0.1 m, about 3 cm of the ground are within a
//              millimetre. This part of the ground may have thousands of triangles. At most
//              kMaxPoints points are chosen: first the deepest point, then repeatedly the point
//              that is farthest from the points chosen before. The gap of a point is its distance
//              minus that of the deepest point. A point with a gap counts as nearer to the chosen
//              points by s = √(2 radius gap), because a cylinder of this radius on a plane has this
//              gap at the distance s from its contact. So on a plane a sphere keeps one point, and
//              a cylinder keeps both ends. A bump is left out if it is lower than 1 % of its
//              distance from a chosen point, unless it is the deepest point.
// Determinism  the chosen points depend on the added points, not on their order.
class MeshPoints {
 public:
  static constexpr std::size_t kMaxPoints = 8;

  // `near` (m): two points with the same normal and at most this distance count as one point.
  // `radius` (m) is the radius of the wheel or sphere. The points are appended to `points`.
  MeshPoints(double margin, double near, double radius, std::vector<TouchPoint>& points)
      : margin_(margin), near_(near), radius_(radius), points_(points), begin_(points.size()) {}

  double margin() const { return margin_; }
  // Adds a contact point. `on_mesh` and `normal` are in the mesh's frame.
  void Add(const geometry::Vector3& on_mesh, const geometry::Vector3& normal, double distance);
  // Chooses among the points, and converts them to the world.
  void Finish(const PlacedPiece& mesh);

 private:
  double DistanceOf(const TouchPoint& a, const TouchPoint& b) const;
  // Reduces the added points to at most kMaxPoints points.
  void Choose();

  const double margin_, near_, radius_;  // see the constructor
  std::vector<TouchPoint>& points_;
  const std::size_t begin_;  // number of points before the first added point
};

}  // namespace gsv::dynamics
