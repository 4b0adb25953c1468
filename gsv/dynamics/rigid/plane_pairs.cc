#include "gsv/dynamics/rigid/plane_pairs.h"

#include <LinearMath/btAabbUtil2.h>

#include "gsv/dynamics/rigid/shape_filter.h"

namespace gsv::dynamics {
namespace {

const btCollisionObject& ObjectOf(const btBroadphaseProxy& proxy) {
  return *static_cast<const btCollisionObject*>(proxy.m_clientObject);
}

bool IsPlane(const btBroadphaseProxy& proxy) {
  return ObjectOf(proxy).getCollisionShape()->getShapeType() == STATIC_PLANE_PROXYTYPE;
}

// The boxes are wider than the bodies by the distance at which contacts begin.
bool IsAbove(const btBroadphaseProxy& body, const btBroadphaseProxy& plane) {
  const auto& shape = *static_cast<const btStaticPlaneShape*>(ObjectOf(plane).getCollisionShape());
  const btTransform& place = ObjectOf(plane).getWorldTransform();
  const btVector3 normal = place.getBasis() * shape.getPlaneNormal();
  const btVector3 lowest(normal.x() > 0 ? body.m_aabbMin.x() : body.m_aabbMax.x(),
                         normal.y() > 0 ? body.m_aabbMin.y() : body.m_aabbMax.y(),
                         normal.z() > 0 ? body.m_aabbMin.z() : body.m_aabbMax.z());
  return normal.dot(lowest - place.getOrigin()) > shape.getPlaneConstant();
}

}  // namespace

void LookAtPairsThatMayTouch(btBroadphasePair& pair, btCollisionDispatcher& dispatcher,
                             const btDispatcherInfo& info) {
  const btBroadphaseProxy &a = *pair.m_pProxy0, &b = *pair.m_pProxy1;
  if (!ShapesMeet(ObjectOf(a).getCollisionShape(), ObjectOf(b).getCollisionShape())) return;
  const bool is_new = pair.m_algorithm == nullptr;
  // The broad phase keeps wider boxes.
  if (is_new && !TestAabbAgainstAabb2(a.m_aabbMin, a.m_aabbMax, b.m_aabbMin, b.m_aabbMax)) return;
  if (is_new && ((IsPlane(a) && IsAbove(b, a)) || (IsPlane(b) && IsAbove(a, b)))) return;
  btCollisionDispatcher::defaultNearCallback(pair, dispatcher, info);
}

}  // namespace gsv::dynamics
