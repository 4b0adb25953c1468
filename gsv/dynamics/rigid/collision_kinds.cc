#include "gsv/dynamics/rigid/collision_kinds.h"

#include <cmath>

#include <BulletCollision/CollisionDispatch/btManifoldResult.h>
#include <BulletCollision/CollisionShapes/btCylinderShape.h>
#include <BulletCollision/CollisionShapes/btStaticPlaneShape.h>

namespace gsv::dynamics {
namespace {

constexpr int kContactPoints = 4, kDirections = 8;

class CylinderOnPlane final : public btCollisionAlgorithm {
 public:
  CylinderOnPlane(const btCollisionAlgorithmConstructionInfo& info,
                  const btCollisionObject& cylinder, const btCollisionObject& plane,
                  bool plane_is_first)
      : btCollisionAlgorithm(info), manifold_(info.m_manifold), plane_is_first_(plane_is_first) {
    if (manifold_ != nullptr || !m_dispatcher->needsCollision(&cylinder, &plane)) return;
    manifold_ = m_dispatcher->getNewManifold(&cylinder, &plane);
    owns_manifold_ = true;
  }
  ~CylinderOnPlane() override {
    if (owns_manifold_) m_dispatcher->releaseManifold(manifold_);
  }

  void processCollision(const btCollisionObjectWrapper* first,
                        const btCollisionObjectWrapper* second, const btDispatcherInfo& /*info*/,
                        btManifoldResult* result) override {
    if (manifold_ == nullptr) return;
    result->setPersistentManifold(manifold_);
    AddPoints(plane_is_first_ ? *second : *first, plane_is_first_ ? *first : *second, *result);
    if (owns_manifold_ && manifold_->getNumContacts() > 0) result->refreshContactPoints();
  }

  btScalar calculateTimeOfImpact(btCollisionObject*, btCollisionObject*, const btDispatcherInfo&,
                                 btManifoldResult*) override {
    return 1;
  }

  void getAllContactManifolds(btManifoldArray& manifolds) override {
    if (owns_manifold_) manifolds.push_back(manifold_);
  }

 private:
  void AddPoints(const btCollisionObjectWrapper& of_cylinder,
                 const btCollisionObjectWrapper& of_plane, btManifoldResult& result) const {
    // A cylinder whose axis leans from the normal by less than about 45° stands on its lower rim.
    // One that leans by less than a milliradian stands upright.
    constexpr double kLies = 0.7, kStandsUpright = 1e-3;
    const auto& plane = *static_cast<const btStaticPlaneShape*>(of_plane.getCollisionShape());
    const btTransform& world_from_plane = of_plane.getWorldTransform();
    const btVector3 normal = world_from_plane.getBasis() * plane.getPlaneNormal();
    const btVector3 on_plane =
        world_from_plane * (plane.getPlaneNormal() * plane.getPlaneConstant());
    const auto& cylinder = *static_cast<const btCylinderShape*>(of_cylinder.getCollisionShape());
    const btVector3 half = cylinder.getHalfExtentsWithMargin();
    const btTransform& world_from_cylinder = of_cylinder.getWorldTransform();
    const btVector3 axis = world_from_cylinder.getBasis().getColumn(2);
    const double up = normal.dot(axis);
    const btVector3 lower = axis * (up > 0 ? -half.z() : half.z());
    const auto add = [&](const btVector3& from_middle) {
      const btVector3 point = world_from_cylinder.getOrigin() + from_middle;
      const double distance = normal.dot(point - on_plane);
      if (distance >= manifold_->getContactBreakingThreshold()) return;
      result.addContactPoint(normal, point - normal * distance, distance);
    };
    btVector3 down = axis * up - normal, aside;
    if (down.length() > kStandsUpright) {
      down.normalize();
      aside = axis.cross(down);
    } else {
      // Uses the same points of the rim as before, in whatever direction the cylinder leans.
      down = world_from_cylinder.getBasis().getColumn(0);
      aside = world_from_cylinder.getBasis().getColumn(1);
    }
    add(lower + down * half.x());
    if (std::abs(up) < kLies) {
      add(-lower + down * half.x());
      return;
    }
    add(lower - down * half.x());
    add(lower + aside * half.x());
    add(lower - aside * half.x());
  }

  btPersistentManifold* manifold_;
  bool plane_is_first_;
  bool owns_manifold_ = false;
};

}  // namespace

struct CollisionKinds::OnPlane final : btCollisionAlgorithmCreateFunc {
  explicit OnPlane(bool plane_is_first) { m_swapped = plane_is_first; }
  btCollisionAlgorithm* CreateCollisionAlgorithm(btCollisionAlgorithmConstructionInfo& info,
                                                 const btCollisionObjectWrapper* first,
                                                 const btCollisionObjectWrapper* second) override {
    const btCollisionObject &cylinder = *(m_swapped ? second : first)->getCollisionObject(),
                            &plane = *(m_swapped ? first : second)->getCollisionObject();
    void* const memory = info.m_dispatcher1->allocateCollisionAlgorithm(sizeof(CylinderOnPlane));
    return new (memory) CylinderOnPlane(info, cylinder, plane, m_swapped);
  }
};

CollisionKinds::CollisionKinds()
    : at_one_point_(m_pdSolver),
      cylinder_on_plane_(std::make_unique<OnPlane>(false)),
      plane_under_cylinder_(std::make_unique<OnPlane>(true)) {
  // A contact area is found at once, not over several substeps.
  setPlaneConvexMultipointIterations(kDirections, kContactPoints);
  setConvexConvexMultipointIterations(kDirections, kContactPoints);
}

CollisionKinds::~CollisionKinds() = default;

btCollisionAlgorithmCreateFunc* CollisionKinds::getCollisionAlgorithmCreateFunc(int first,
                                                                                int second) {
  const auto is_sphere = [](int kind) { return kind == SPHERE_SHAPE_PROXYTYPE; };
  const auto is_cylinder = [](int kind) { return kind == CYLINDER_SHAPE_PROXYTYPE; };
  const auto is_plane = [](int kind) { return kind == STATIC_PLANE_PROXYTYPE; };
  if (is_cylinder(first) && is_plane(second)) return cylinder_on_plane_.get();
  if (is_plane(first) && is_cylinder(second)) return plane_under_cylinder_.get();
  if ((is_sphere(first) != is_sphere(second)) && btBroadphaseProxy::isConvex(first) &&
      btBroadphaseProxy::isConvex(second)) {
    return &at_one_point_;
  }
  return btDefaultCollisionConfiguration::getCollisionAlgorithmCreateFunc(first, second);
}

}  // namespace gsv::dynamics
