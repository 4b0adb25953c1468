// Finds the points at which two pieces touch by Bullet's algorithms. These algorithms are used
// where placed_piece.h has no closed form: for cones and hulls, and for most pairs of a mesh or a
// cylinder with another piece. Private to this folder: it includes Bullet.
//
// Determinism  no data is kept from one call to the next.
#pragma once

#include <BulletCollision/CollisionDispatch/btConvexConvexAlgorithm.h>
#include <BulletCollision/CollisionDispatch/btDefaultCollisionConfiguration.h>

#include "gsv/dynamics/rigid/placed_piece.h"

namespace gsv::dynamics {

// Selects Bullet's collision algorithms. Bullet finds more contact points by rotating a shape
// slightly. This is switched off for spheres, which touch any convex shape at one point.
class PairAlgorithms final : public btDefaultCollisionConfiguration {
 public:
  PairAlgorithms();
  btCollisionAlgorithmCreateFunc* getCollisionAlgorithmCreateFunc(int first, int second) override;

 private:
  btConvexConvexAlgorithm::CreateFunc at_one_point_;  // the algorithm for spheres
};

// Finds the contact points of two pieces with Bullet.
class BulletPairs {
 public:
  BulletPairs();
  // Adds the points at which the two pieces are closer than `margin`.
  void AddTouchPoints(const PlacedPiece& first, const PlacedPiece& second, double margin,
                      std::vector<TouchPoint>& points);

 private:
  // Adds the points of Bullet's manifold that are closer than `margin`.
  void Read(const btPersistentManifold& manifold, double margin, std::vector<TouchPoint>& points);

  PairAlgorithms algorithms_;
  btCollisionDispatcher dispatcher_;
  btCollisionObject first_, second_;  // the two pieces, in Bullet's form
  btManifoldArray manifolds_;         // memory that is used again in each call
};

}  // namespace gsv::dynamics
