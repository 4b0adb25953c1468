// Selects the algorithm that finds the contacts of two shapes: Bullet's, except for two kinds of
// pairs. Private to this folder: it includes Bullet.
//
// Sphere    against any convex shape: one point. Bullet finds further points by turning a shape a
//           little, which moves a sphere's only point.
// Cylinder  against a plane: the lowest point of both rims, or four points of the rim on which it
//           stands. Bullet finds one point, so that a wheel would stand on one of its edges.
#pragma once

#include <memory>

#include <BulletCollision/CollisionDispatch/btConvexConvexAlgorithm.h>
#include <BulletCollision/CollisionDispatch/btDefaultCollisionConfiguration.h>

namespace gsv::dynamics {

class CollisionKinds final : public btDefaultCollisionConfiguration {
 public:
  CollisionKinds();
  ~CollisionKinds() override;
  btCollisionAlgorithmCreateFunc* getCollisionAlgorithmCreateFunc(int first, int second) override;

 private:
  struct OnPlane;

  btConvexConvexAlgorithm::CreateFunc at_one_point_;
  std::unique_ptr<OnPlane> cylinder_on_plane_, plane_under_cylinder_;
};

}  // namespace gsv::dynamics
