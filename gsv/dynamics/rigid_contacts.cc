#include "gsv/dynamics/rigid_contacts.h"

#include <algorithm>
#include <tuple>

namespace gsv::dynamics {
namespace {

// m: closer than this is touching.
constexpr double kTouching = 1e-4;
// What is below and steeper than 45° to nothing carries.
constexpr double kCarries = 0.70710678118654757;

// Which child of its compound was touched.
const model::Surface& SurfaceOf(const btCollisionObjectWrapper* wrapper) {
  const auto& owner = *static_cast<const Owner*>(wrapper->getCollisionObject()->getUserPointer());
  for (const auto* w = wrapper; w->m_parent != nullptr; w = w->m_parent) {
    if (w->m_parent->getCollisionShape()->isCompound()) {
      return owner.solid->surfaces[static_cast<std::size_t>(w->m_index)];
    }
  }
  return owner.solid->surfaces.front();
}

bool TakeSurfaces(btManifoldPoint& point, const btCollisionObjectWrapper* first, int, int,
                  const btCollisionObjectWrapper* second, int, int) {
  const model::Surface& a = SurfaceOf(first);
  const model::Surface& b = SurfaceOf(second);
  point.m_combinedFriction = std::min(a.friction, b.friction);
  point.m_combinedRestitution = a.restitution * b.restitution;
  return true;
}

}  // namespace

void InstallSurfaces() { gContactAddedCallback = TakeSurfaces; }

void RigidContacts::Clear() {
  found_.clear();
  at_start_.clear();
  is_first_ = true;
}

void RigidContacts::Add(const Owner& first, const Owner& second,
                        const btPersistentManifold& manifold) {
  const BodyPair pair{first.solid->body, second.solid->body};
  for (int i = 0; i < manifold.getNumContacts(); ++i) {
    const btManifoldPoint& point = manifold.getContactPoint(i);
    if (is_first_ && point.getDistance() <= kTouching) at_start_.push_back(pair);
    if (point.getDistance() > kTouching && !(point.getAppliedImpulse() > 0)) continue;
    // Bullet's normal points from its second body to its first.
    const bool swapped = manifold.getBody0()->getUserPointer() != &first;
    geometry::Vector3 normal = FromBullet(point.m_normalWorldOnB);
    if (!swapped) normal = -normal;
    if (!second.moves_by_forces && normal.z < -kCarries) continue;
    const btVector3 middle = (point.getPositionWorldOnA() + point.getPositionWorldOnB()) / 2;
    found_.push_back({pair.first, pair.second, FromBullet(middle), normal,
                      std::max(0.0, -point.getDistance()), false});
  }
}

void RigidContacts::Read(btDispatcher& dispatcher) {
  for (int i = 0; i < dispatcher.getNumManifolds(); ++i) {
    const btPersistentManifold& manifold = *dispatcher.getManifoldByIndexInternal(i);
    if (manifold.getNumContacts() == 0) continue;
    auto& a = *static_cast<Owner*>(manifold.getBody0()->getUserPointer());
    auto& b = *static_cast<Owner*>(manifold.getBody1()->getUserPointer());
    a.touches = b.touches = true;
    const bool in_order =
        a.moves_by_forces && (!b.moves_by_forces || a.solid->body < b.solid->body);
    Add(in_order ? a : b, in_order ? b : a, manifold);
  }
  is_first_ = false;
}

void RigidContacts::AddTo(std::vector<world::Contact>& contacts) {
  const auto pair_of = [](const world::Contact& c) { return BodyPair{c.first, c.second}; };
  std::stable_sort(found_.begin(), found_.end(), [](const auto& a, const auto& b) {
    return std::make_tuple(a.first, a.second, -a.depth) <
           std::make_tuple(b.first, b.second, -b.depth);
  });
  std::sort(at_start_.begin(), at_start_.end());
  for (std::size_t i = 0; i < found_.size(); ++i) {
    if (i > 0 && pair_of(found_[i]) == pair_of(found_[i - 1])) continue;
    found_[i].began = !std::binary_search(at_start_.begin(), at_start_.end(), pair_of(found_[i]));
    contacts.push_back(found_[i]);
  }
}

}  // namespace gsv::dynamics
