#include "gsv/dynamics/rigid/kept_impulses.h"

#include <algorithm>

namespace gsv::dynamics {
namespace {

using geometry::Vector3;

BodyPair BodiesOf(const ContactFinder& finder, const Contact& contact) {
  return {finder.collider(contact.first).solid->body, finder.collider(contact.second).solid->body};
}

}  // namespace

void KeptImpulses::AddToHash(base::Hash& hash) const {
  hash.Add(static_cast<std::int64_t>(entries_.size()));
  for (const Entry& entry : entries_) {
    hash.Add(static_cast<std::int64_t>(entry.bodies.first));
    hash.Add(static_cast<std::int64_t>(entry.bodies.second));
    for (const Vector3& v : {entry.point, entry.force}) {
      for (const double value : {v.x, v.y, v.z}) hash.Add(value);
    }
  }
}

void KeptImpulses::Add(const ContactFinder& finder, const Contact& contact, double substep) {
  if (!(contact.impulse[0] > 0)) return;
  const Vector3 impulse = contact.impulse[0] * contact.point.normal +
                          contact.impulse[1] * contact.axes[0] +
                          contact.impulse[2] * contact.axes[1];
  entries_.push_back(
      {BodiesOf(finder, contact), finder.PointOnFirst(contact), (1 / substep) * impulse});
}

void KeptImpulses::Finish() {
  std::stable_sort(entries_.begin(), entries_.end(),
                   [](const Entry& a, const Entry& b) { return a.bodies < b.bodies; });
}

void KeptImpulses::StartFrom(const ContactFinder& finder, std::vector<Contact>& contacts,
                             double substep) const {
  constexpr double kNear = 0.01;  // m
  for (Contact& contact : contacts) {
    const BodyPair bodies = BodiesOf(finder, contact);
    const auto begin =
        std::lower_bound(entries_.begin(), entries_.end(), bodies,
                         [](const Entry& entry, const BodyPair& of) { return entry.bodies < of; });
    if (begin == entries_.end() || begin->bodies != bodies) continue;
    const Vector3 point = finder.PointOnFirst(contact);
    double nearest = kNear * kNear;
    for (auto at = begin; at != entries_.end() && at->bodies == bodies; ++at) {
      const Vector3 between = at->point - point;
      if (!(Dot(between, between) < nearest)) continue;
      nearest = Dot(between, between);
      const Vector3 impulse = substep * at->force;
      contact.impulse = {std::max(0.0, Dot(impulse, contact.point.normal)),
                         Dot(impulse, contact.axes[0]), Dot(impulse, contact.axes[1])};
    }
  }
}

}  // namespace gsv::dynamics
