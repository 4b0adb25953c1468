#include <algorithm>
#include <cmath>

#include "gsv/dynamics/rigid/contact.h"

namespace gsv::dynamics {
namespace {

// m/s: bodies that collide at a lower speed do not bounce
constexpr double kBounces = 0.05;
// The fraction of an overlap with a tree of links that a substep corrects.
constexpr double kTreeCorrection = 0.2;
// m/s: contacts that close more slowly are not impacts.
constexpr double kImpact = 0.05;

}  // namespace

std::array<double, 3> TargetsOf(const Contact& contact, bool has_tree, double meeting,
                                const std::array<double, 3>& free, double substep) {
  double wanted = 0;
  if (contact.restitution > 0 && std::abs(meeting) >= kBounces) {
    wanted = std::max(0.0, -contact.restitution * meeting);
  }
  // A gap may close by the end of the step. An overlap with a tree of links is removed over several
  // steps. OverlapRemoval removes an overlap of bodies without joints.
  const double gap = contact.point.distance + kRestingDepth;
  wanted -= (gap > 0 ? 1 : (has_tree ? kTreeCorrection : 0)) * gap / substep;
  // `share` is the fraction of the slip that friction removes in this substep. If the bodies still
  // have a gap, they close it in this substep at the speed `kept`, and lose this speed in the next
  // substep. In this substep they lose only the speed `taken`. So friction removes the same
  // fraction of the slip as the contact removes of the closing speed. Otherwise a body that lands
  // on two edges at once would be thrown to one side.
  const double kept = gap / substep, taken = wanted - free[0];
  const double share = kept > kImpact && taken > 0 ? taken / (taken + kept) : 1;
  return {wanted, (1 - share) * free[1], (1 - share) * free[2]};
}

}  // namespace gsv::dynamics
