#include "gsv/dynamics/rigid/bullet_pairs.h"

#include <BulletCollision/CollisionDispatch/btCollisionObjectWrapper.h>
#include <BulletCollision/CollisionDispatch/btManifoldResult.h>

#include "gsv/dynamics/rigid/bullet_types.h"

namespace gsv::dynamics {
namespace {

constexpr int kContactPoints = 4, kDirections = 8;

btTransform TransformOf(const PlacedPiece& placed) {
  const auto& [x, y, z] = placed.rotation;
  return btTransform(btMatrix3x3(x.x, y.x, z.x, x.y, y.y, z.y, x.z, y.z, z.z),
                     ToBullet(placed.position));
}

}  // namespace

PairAlgorithms::PairAlgorithms() : at_one_point_(m_pdSolver) {
  // With these settings, Bullet finds all points of a contact area in one call. By default it would
  // collect them over several substeps.
  setPlaneConvexMultipointIterations(kDirections, kContactPoints);
  setConvexConvexMultipointIterations(kDirections, kContactPoints);
}

btCollisionAlgorithmCreateFunc* PairAlgorithms::getCollisionAlgorithmCreateFunc(int first,
                                                                                int second) {
  const auto is_sphere = [](int kind) { return kind == SPHERE_SHAPE_PROXYTYPE; };
  if ((is_sphere(first) != is_sphere(second)) && btBroadphaseProxy::isConvex(first) &&
      btBroadphaseProxy::isConvex(second)) {
    return &at_one_point_;
  }
  return btDefaultCollisionConfiguration::getCollisionAlgorithmCreateFunc(first, second);
}

BulletPairs::BulletPairs() : dispatcher_(&algorithms_) {}

void BulletPairs::Read(const btPersistentManifold& manifold, double margin,
                       std::vector<TouchPoint>& points) {
  const bool is_swapped = manifold.getBody0() != &first_;
  for (int i = 0; i < manifold.getNumContacts(); ++i) {
    const btManifoldPoint& point = manifold.getContactPoint(i);
    if (!(point.getDistance() < margin)) continue;
    const geometry::Vector3 normal = FromBullet(point.m_normalWorldOnB);
    points.push_back(
        {FromBullet(is_swapped ? point.getPositionWorldOnA() : point.getPositionWorldOnB()),
         is_swapped ? -normal : normal, point.getDistance()});
  }
}

void BulletPairs::AddTouchPoints(const PlacedPiece& first, const PlacedPiece& second, double margin,
                                 std::vector<TouchPoint>& points) {
  first_.setCollisionShape(first.piece->shape);
  second_.setCollisionShape(second.piece->shape);
  first_.setWorldTransform(TransformOf(first));
  second_.setWorldTransform(TransformOf(second));
  const btCollisionObjectWrapper a(nullptr, first_.getCollisionShape(), &first_,
                                   first_.getWorldTransform(), -1, -1);
  const btCollisionObjectWrapper b(nullptr, second_.getCollisionShape(), &second_,
                                   second_.getWorldTransform(), -1, -1);
  btCollisionAlgorithm* const algorithm =
      dispatcher_.findAlgorithm(&a, &b, nullptr, BT_CONTACT_POINT_ALGORITHMS);
  if (algorithm == nullptr) return;
  btManifoldResult result(&a, &b);
  const btDispatcherInfo info;
  algorithm->processCollision(&a, &b, info, &result);
  manifolds_.resize(0);
  algorithm->getAllContactManifolds(manifolds_);
  for (int i = 0; i < manifolds_.size(); ++i) Read(*manifolds_[i], margin, points);
  algorithm->~btCollisionAlgorithm();
  dispatcher_.freeCollisionAlgorithm(algorithm);
}

}  // namespace gsv::dynamics
