// Finds the points at which two pieces touch, by Bullet's algorithms, for shapes without a closed
// form here: cones, hulls, meshes, and cylinders that are not on a plane. Private to this folder:
// it includes Bullet.
//
// Determinism  no data is kept from one call to the next.
#pragma once

#include <BulletCollision/CollisionDispatch/btConvexConvexAlgorithm.h>
#include <BulletCollision/CollisionDispatch/btDefaultCollisionConfiguration.h>

#include "gsv/dynamics/rigid/placed_piece.h"

namespace gsv::dynamics {

// Bullet's algorithms. A sphere touches any convex shape at one point, so it needs none of the
// further points that Bullet finds by rotating a shape slightly.
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
  // Adds the points at which the two pieces are closer than `margin`.
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
