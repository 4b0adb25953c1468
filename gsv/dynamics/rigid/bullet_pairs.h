// The points at which two pieces touch that have no closed form of ours, by Bullet's algorithms:
// cones, hulls, meshes, and cylinders that are not on a plane. Private to this folder: it includes
// Bullet.
//
// Determinism  nothing is kept from one call to the next.
#pragma once

#include <BulletCollision/CollisionDispatch/btConvexConvexAlgorithm.h>
#include <BulletCollision/CollisionDispatch/btDefaultCollisionConfiguration.h>

#include "gsv/dynamics/rigid/placed_piece.h"

namespace gsv::dynamics {

// Bullet's algorithms. A sphere touches any convex shape at one point: Bullet finds further points
// by turning a shape a little, which moves a sphere's only point.
class PairAlgorithms final : public btDefaultCollisionConfiguration {
 public:
  PairAlgorithms();
  btCollisionAlgorithmCreateFunc* getCollisionAlgorithmCreateFunc(int first, int second) override;

 private:
  btConvexConvexAlgorithm::CreateFunc at_one_point_;
};

class BulletPairs {
 public:
  BulletPairs();
  // Adds the points at which the two are closer than `margin`.
  void AddTouchPoints(const PlacedPiece& first, const PlacedPiece& second, double margin,
                      std::vector<TouchPoint>& points);

 private:
  void Read(const btPersistentManifold& manifold, double margin, std::vector<TouchPoint>& points);

  PairAlgorithms algorithms_;
  btCollisionDispatcher dispatcher_;
  btCollisionObject first_, second_;
  btManifoldArray manifolds_;
};

}  // namespace gsv::dynamics
