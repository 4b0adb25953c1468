#include "gsv/dynamics/rigid/rigid_contacts.h"

#include <algorithm>
#include <tuple>

#include <BulletCollision/CollisionDispatch/btCompoundCompoundCollisionAlgorithm.h>

#include "gsv/dynamics/rigid/shape_filter.h"

namespace gsv::dynamics {
namespace {

// m: closer than this is touching.
constexpr double kTouchingDistance = 1e-4;
// A body carries another from below if the normal is within 45° of the vertical (its cosine).
constexpr double kCarries = 0.70710678118654757;

const Owner& OwnerOf(const btCollisionObjectWrapper* wrapper) {
  return *static_cast<const Owner*>(wrapper->getCollisionObject()->getUserPointer());
}

// Which child of its compound was touched.
const model::Surface& SurfaceOf(const btCollisionObjectWrapper* wrapper) {
  const Owner& owner = OwnerOf(wrapper);
  for (const auto* w = wrapper; w->m_parent != nullptr; w = w->m_parent) {
    if (w->m_parent->getCollisionShape()->isCompound()) {
      return owner.solid->surfaces[static_cast<std::size_t>(w->m_index)];
    }
  }
  return owner.solid->surfaces.front();
}

bool IsSlantwise(const model::Surface& surface) { return surface.friction != surface.friction2; }

// The direction of the first of the two frictions, in the world.
btVector3 DirectionOf(const model::Surface& surface, const btCollisionObjectWrapper* wrapper) {
  const geometry::Vector3& direction = surface.friction_direction;
  if (Dot(direction, direction) == 0) return {1, 0, 0};
  return wrapper->getWorldTransform().getBasis() * ToBullet(direction);
}

// The contact has less friction across `direction` than along it, or more. Bullet knows one
// coefficient: where a direction is shorter than one, so much less force acts along it. Returns null
// without friction.
FrictionAxes* TakeDirections(const btVector3& direction, double along, double across,
                             std::deque<FrictionAxes>& axes, btManifoldPoint& point) {
  constexpr double kShortest = 1e-6;
  const btVector3& normal = point.m_normalWorldOnB;
  btVector3 first = direction - direction.dot(normal) * normal;
  if (first.length() < kShortest) btPlaneSpace1(normal, first, point.m_lateralFrictionDir2);
  first.normalize();
  const double most = std::max(along, across);
  if (!(most > 0)) return nullptr;
  point.m_combinedFriction = most;
  point.m_lateralFrictionDir1 = first * std::max(along / most, kShortest);
  point.m_lateralFrictionDir2 = normal.cross(first) * std::max(across / most, kShortest);
  point.m_contactPointFlags |= BT_CONTACT_FLAG_LATERAL_FRICTION_INITIALIZED;
  // Bullet overwrites the point's own axes where a tree of links is touched.
  FrictionAxes& kept = axes.emplace_back(
      FrictionAxes{point.m_lateralFrictionDir1, point.m_lateralFrictionDir2, {}, {}, nullptr, 1});
  point.m_userPersistentData = &kept;
  return &kept;
}

bool HasSlip(const model::Surface& surface) { return surface.slip != 0 || surface.slip2 != 0; }

// The wheel of a contact and the surface on which it rolls. Null if it has no wheel that slips.
struct Rolling {
  const Owner* wheel = nullptr;
  model::Slip ground;

  btVector3 AxleInWorld(const btCollisionObjectWrapper* wrapper) const {
    return wrapper->getCollisionObject()->getWorldTransform().getBasis() *
           ToBullet(wheel->solid->wheel->axle);
  }
};

Rolling RollingOf(const Owner& owner, const model::Surface& ground) {
  const auto& wheel = owner.solid->wheel;
  if (!wheel || (wheel->wheel.slip.is_none() && ground.wheel_slip.is_none())) return {};
  return {&owner, ground.wheel_slip};
}

// `axes` are along and across the rolling direction, or across and along it.
void TakeSlip(const Rolling& rolling, bool is_along, FrictionAxes& axes) {
  const RollingWheel& wheel = *rolling.wheel->solid->wheel;
  axes.slip_per_rate = {wheel.PerRateAlong(rolling.ground), wheel.PerRateAcross(rolling.ground)};
  if (!is_along) std::swap(axes.slip_per_rate[0], axes.slip_per_rate[1]);
  axes.rate = &rolling.wheel->rate;
}

// The impulse (N s) of a substep on the first of Bullet's bodies.
btVector3 ImpulseOf(const btManifoldPoint& point) {
  const auto* axes = static_cast<const FrictionAxes*>(point.m_userPersistentData);
  const btVector3& first = axes != nullptr ? axes->first : point.m_lateralFrictionDir1;
  const btVector3& second = axes != nullptr ? axes->second : point.m_lateralFrictionDir2;
  return point.m_appliedImpulse * point.m_normalWorldOnB + point.m_appliedImpulseLateral1 * first +
         point.m_appliedImpulseLateral2 * second;
}

// Adds to the impulses of points what the two bodies exchanged besides, in earlier substeps: in
// proportion to the points' normal impulses, or in equal shares.
void ShareImpulse(const geometry::Vector3& total, std::vector<world::ContactPoint>& points) {
  geometry::Vector3 rest = total;
  double weight = 0;
  for (const world::ContactPoint& point : points) {
    rest -= point.impulse;
    weight += std::max(0.0, Dot(point.impulse, point.normal));
  }
  for (world::ContactPoint& point : points) {
    const double share = weight > 0 ? std::max(0.0, Dot(point.impulse, point.normal)) / weight
                                    : 1 / static_cast<double>(points.size());
    point.impulse += share * rest;
  }
}

// The normal points from the second to the first.
bool GlidesOn(const Owner& first, const Owner& second, const btVector3& normal) {
  return (first.is_held && normal.z() > kCarries) || (second.is_held && normal.z() < -kCarries);
}

bool TakeSurfaces(btManifoldPoint& point, const btCollisionObjectWrapper* first, int, int,
                  const btCollisionObjectWrapper* second, int, int) {
  const model::Surface& a = SurfaceOf(first);
  const model::Surface& b = SurfaceOf(second);
  const Owner &first_owner = OwnerOf(first), &second_owner = OwnerOf(second);
  point.m_combinedRestitution = a.restitution * b.restitution;
  point.m_userPersistentData = nullptr;
  if (GlidesOn(first_owner, second_owner, point.m_normalWorldOnB)) {
    point.m_combinedFriction = 0;
    return true;
  }
  point.m_combinedFriction = std::min(a.friction, b.friction);
  const bool has_direction = IsSlantwise(a) || IsSlantwise(b) || HasSlip(a) || HasSlip(b);
  const Rolling of_first = RollingOf(first_owner, b);
  const Rolling rolling = of_first.wheel != nullptr ? of_first : RollingOf(second_owner, a);
  if (!has_direction && rolling.wheel == nullptr) return true;
  btVector3 forwards;
  if (rolling.wheel != nullptr) {
    forwards = rolling.AxleInWorld(of_first.wheel != nullptr ? first : second)
                   .cross(point.m_normalWorldOnB);
  }
  btVector3 direction = forwards;
  if (has_direction) {
    // If both surfaces have a direction, that of the more slippery one is used.
    const bool first_tells =
        (IsSlantwise(a) || HasSlip(a)) &&
        (!(IsSlantwise(b) || HasSlip(b)) ||
         std::min(a.friction, a.friction2) <= std::min(b.friction, b.friction2));
    direction = first_tells ? DirectionOf(a, first) : DirectionOf(b, second);
  }
  FrictionAxes* const axes =
      TakeDirections(direction, std::min(a.friction, b.friction),
                     std::min(a.friction2, b.friction2), *first_owner.axes, point);
  if (axes == nullptr) return true;
  axes->slip = {a.slip + b.slip, a.slip2 + b.slip2};
  if (rolling.wheel != nullptr) {
    const double along = std::abs(forwards.dot(axes->first)) / axes->first.length();
    const double across = std::abs(forwards.dot(axes->second)) / axes->second.length();
    TakeSlip(rolling, along >= across, *axes);
  }
  return true;
}

}  // namespace

void InstallSurfaces() {
  gContactAddedCallback = TakeSurfaces;
  gCompoundChildShapePairCallback = ShapesMeet;
  gCompoundCompoundChildShapePairCallback = ShapesMeet;
}

void RigidContacts::Clear() {
  found_.clear();
  at_start_.clear();
  substep_ = 0;
}

void RigidContacts::Add(const Owner& first, const Owner& second,
                        const btPersistentManifold& manifold) {
  const BodyPair pair{first.solid->body, second.solid->body};
  for (int i = 0; i < manifold.getNumContacts(); ++i) {
    const btManifoldPoint& point = manifold.getContactPoint(i);
    if (substep_ == 0 && point.getDistance() <= kTouchingDistance) at_start_.push_back(pair);
    if (point.getDistance() > kTouchingDistance && !(point.getAppliedImpulse() > 0)) continue;
    // Bullet's normal points from its second body to its first.
    const bool swapped = manifold.getBody0()->getUserPointer() != &first;
    geometry::Vector3 normal = FromBullet(point.m_normalWorldOnB);
    if (!swapped) normal = -normal;
    const btVector3 middle = (point.getPositionWorldOnA() + point.getPositionWorldOnB()) / 2;
    Found& found = found_.emplace_back(Found{{}, {}, substep_});
    world::Contact& contact = found.contact;
    contact.first = pair.first;
    contact.second = pair.second;
    contact.point = FromBullet(middle);
    contact.normal = normal;
    contact.depth = std::max(0.0, -point.getDistance());
    // The solver leaves out points beyond the threshold: they keep the impulse of a substep before.
    const bool is_solved = point.getDistance() <= manifold.getContactProcessingThreshold();
    contact.impulse = is_solved ? point.getAppliedImpulse() : 0;
    if (is_solved) found.impulse = (swapped ? 1.0 : -1.0) * FromBullet(ImpulseOf(point));
    contact.supports = !second.is_rigid && normal.z < -kCarries;
  }
}

void RigidContacts::Read(btDispatcher& dispatcher) {
  for (int i = 0; i < dispatcher.getNumManifolds(); ++i) {
    const btPersistentManifold& manifold = *dispatcher.getManifoldByIndexInternal(i);
    if (manifold.getNumContacts() == 0) continue;
    auto& a = *static_cast<Owner*>(manifold.getBody0()->getUserPointer());
    auto& b = *static_cast<Owner*>(manifold.getBody1()->getUserPointer());
    a.touches = b.touches = true;
    const bool in_order = a.is_rigid && (!b.is_rigid || a.solid->body < b.solid->body);
    Add(in_order ? a : b, in_order ? b : a, manifold);
  }
  ++substep_;
}

void RigidContacts::Store(std::vector<world::Contact>& contacts) {
  std::size_t count = 0;
  // The next contact, with the memory of the one that was there.
  const auto next = [&](const world::Contact& contact) -> world::Contact& {
    if (count == contacts.size()) contacts.emplace_back();
    world::Contact& kept = contacts[count++];
    auto points = std::move(kept.points);
    points.clear();
    kept = contact;
    kept.points = std::move(points);
    return kept;
  };
  const auto key_of = [](const Found& found) {
    return std::make_tuple(found.contact.first, found.contact.second, found.contact.supports);
  };
  std::stable_sort(found_.begin(), found_.end(), [&](const Found& a, const Found& b) {
    return std::make_tuple(key_of(a), -a.contact.depth) <
           std::make_tuple(key_of(b), -b.contact.depth);
  });
  std::sort(at_start_.begin(), at_start_.end());
  for (auto begin = found_.begin(); begin != found_.end();) {
    const auto end = std::find_if(
        begin, found_.end(), [&](const Found& found) { return key_of(found) != key_of(*begin); });
    const int last = std::max_element(begin, end, [](const Found& a, const Found& b) {
                       return a.substep < b.substep;
                     })->substep;
    world::Contact& contact = next(begin->contact);
    contact.impulse = 0;
    geometry::Vector3 total;
    contact.began = !std::binary_search(at_start_.begin(), at_start_.end(),
                                        BodyPair{contact.first, contact.second});
    for (auto found = begin; found != end; ++found) {
      contact.impulse += found->contact.impulse;
      total += found->impulse;
      if (found->substep < last) continue;
      contact.points.push_back(
          {found->contact.point, found->contact.normal, found->contact.depth, found->impulse});
    }
    ShareImpulse(total, contact.points);
    begin = end;
  }
  contacts.resize(count);
}

}  // namespace gsv::dynamics
