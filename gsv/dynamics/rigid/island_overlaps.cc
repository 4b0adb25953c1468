// Separates the overlapping bodies of an island, for IslandSolver.
#include <algorithm>

#include "gsv/dynamics/rigid/island_solver.h"

namespace gsv::dynamics {
namespace {

using geometry::Vector3;

// m: overlaps that are less deep stay, so that bodies at rest on each other are not moved.
constexpr double kTolerated = 1e-4;

std::size_t PlaceOf(int i) { return static_cast<std::size_t>(i); }

}  // namespace

// The velocities of Solve() remove the overlaps of bodies with joints. This function removes the
// overlaps between bodies without joints, for which bodies with joints are fixed obstacles.
void IslandSolver::RemoveOverlaps(const ContactFinder& finder,
                                  std::span<const std::unique_ptr<MovingBody>> bodies,
                                  const std::vector<Contact>& contacts, double substep,
                                  std::span<Vector3> shifts) {
  if (contacts_.empty()) return;
  overlaps_.Clear();
  for (const int moving : bodies_) {
    const LinkTree& tree = bodies[PlaceOf(moving)]->tree();
    overlaps_.AddBody(tree.is_single() ? 1 / tree.part_mass(0) : 0);
  }
  for (const int index : contacts_) {
    const Contact& contact = contacts[PlaceOf(index)];
    int sides[2] = {-1, -1};
    bool has_single = false, has_tree = false;
    double speed = 0;
    for (const std::size_t s : {0, 1}) {
      const Collider& collider = finder.collider(s == 0 ? contact.first : contact.second);
      const Vector3 point = s == 0 ? contact.on_first() : contact.point.on_second;
      const double sign = s == 0 ? 1 : -1;
      const MovingBody* const body =
          collider.moving >= 0 ? bodies[PlaceOf(collider.moving)].get() : nullptr;
      if (body == nullptr || body->tree().size() == 0) {
        speed += sign * Dot(contact.point.normal, finder.VelocityOf(collider, point));
        continue;
      }
      has_tree = has_tree || !body->tree().is_single();
      has_single = has_single || body->tree().is_single();
      sides[s] = place_of_[PlaceOf(collider.moving)];
      if (!body->tree().is_single()) continue;
      const double* const v = velocities_.data() + first_[PlaceOf(sides[s])];
      const Vector3 arm = point - body->tree().position(0);
      const Vector3 velocity = Vector3{v[3], v[4], v[5]} + Cross(Vector3{v[0], v[1], v[2]}, arm);
      speed += sign * Dot(contact.point.normal, velocity);
    }
    if (!has_single) continue;
    const double distance = contact.point.distance + (has_tree ? 0 : substep * speed);
    double gap = distance + kTolerated;
    if (has_tree || gap > 0) gap = std::max(distance + kRestingDepth, 0.0);
    overlaps_.AddContact(sides[0], sides[1], contact.point.normal, gap);
  }
  if (!overlaps_.Solve(substep)) return;
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    shifts[PlaceOf(bodies_[b])] = overlaps_.velocity(static_cast<int>(b));
  }
}

}  // namespace gsv::dynamics
