#include "gsv/dynamics/rigid/rigid_contacts.h"

#include <algorithm>
#include <tuple>

namespace gsv::dynamics {
namespace {

// m: bodies that are closer than this touch
constexpr double kTouchingDistance = 1e-4;
// Cosine of 45°. A body that rigid-body dynamics does not move carries another body from below if
// the normal is within 45° of the vertical.
constexpr double kSupports = 0.70710678118654757;

// Distributes among the points the impulses of earlier substeps between the two bodies. Each point
// gets a share in proportion to its normal impulse. If all normal impulses are zero, the shares are
// equal.
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

}  // namespace

void RigidContacts::Clear() {
  found_.clear();
  at_start_.clear();
  substep_ = 0;
}

void RigidContacts::Add(const ContactFinder& finder, const std::vector<Contact>& contacts) {
  for (const Contact& each : contacts) {
    const TouchPoint& point = each.point;
    if (point.distance > kTouchingDistance && !(each.impulse[0] > 0)) continue;
    const Collider* first = &finder.collider(each.first);
    const Collider* second = &finder.collider(each.second);
    geometry::Vector3 normal = -point.normal;
    // `impulse` acts on the second body, and `each.impulse` on the first body. So the signs differ.
    geometry::Vector3 impulse =
        each.impulse[0] * normal - each.impulse[1] * each.axes[0] - each.impulse[2] * each.axes[1];
    if (second->moving >= 0 && (first->moving < 0 || second->solid->body < first->solid->body)) {
      std::swap(first, second);
      normal = -normal;
      impulse = -impulse;
    }
    const BodyPair pair{first->solid->body, second->solid->body};
    if (substep_ == 0 && point.distance <= kTouchingDistance) at_start_.push_back(pair);
    world::Contact& contact = found_.emplace_back(Found{{}, impulse, substep_}).contact;
    contact.first = pair.first;
    contact.second = pair.second;
    contact.point = 0.5 * (each.on_first() + point.on_second);
    contact.normal = normal;
    contact.depth = std::max(0.0, -point.distance);
    contact.impulse = each.impulse[0];
    contact.supports = second->moving < 0 && normal.z < -kSupports;
  }
  ++substep_;
}

void RigidContacts::Store(std::vector<world::Contact>& contacts) {
  std::size_t count = 0;
  // Returns the next element of `contacts`, and reuses its memory.
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
