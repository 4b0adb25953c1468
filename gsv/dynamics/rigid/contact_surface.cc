#include <algorithm>
#include <cmath>

#include "gsv/dynamics/rigid/contact.h"

namespace gsv::dynamics {
namespace {

using geometry::Vector3;

bool HasSlip(const model::Surface& surface) { return surface.slip != 0 || surface.slip2 != 0; }

bool HasDirection(const model::Surface& surface) {
  return surface.friction != surface.friction2 || HasSlip(surface);
}

// Returns the direction of the first of the two friction coefficients, in the world.
Vector3 DirectionOf(const PlacedPiece& piece) {
  const Vector3& direction = piece.piece->surface.friction_direction;
  if (Dot(direction, direction) == 0) return {1, 0, 0};
  return piece.rotation * direction;
}

// Sets the axes of friction along and across `direction`, with these two friction coefficients.
void TakeDirections(const Vector3& direction, double along, double across, Contact& contact) {
  constexpr double kShortest = 1e-6;
  const double most = std::max(along, across);
  if (!(most > 0)) return;
  const Vector3& normal = contact.point.normal;
  Vector3 first = direction - Dot(direction, normal) * normal;
  if (Norm(first) < kShortest) first = contact.axes[0];
  first = Normalized(first);
  contact.friction = most;
  contact.axes = {std::max(along / most, kShortest) * first,
                  std::max(across / most, kShortest) * Cross(normal, first)};
}

// Adds the slip of a wheel to the slip of the surfaces. The slip along the wheel's rolling
// direction is added to the contact's axis that is nearest to this direction. The slip along the
// axle is added to the other axis.
void AddSlip(const SlippingContact& wheel, Contact& contact) {
  const auto [first, second] = contact.axes;
  const double along_first = std::abs(Dot(wheel.forwards, first)) / Norm(first);
  const double along_second = std::abs(Dot(wheel.forwards, second)) / Norm(second);
  const bool is_along = along_first >= along_second;
  contact.slip[0] += is_along ? wheel.along : wheel.across;
  contact.slip[1] += is_along ? wheel.across : wheel.along;
}

}  // namespace

void SetSurfaces(const PlacedPiece& first, const PlacedPiece& second, const SlippingContact* wheel,
                 Contact& contact) {
  const model::Surface &a = first.piece->surface, &b = second.piece->surface;
  contact.restitution = a.restitution * b.restitution;
  contact.friction = std::min(a.friction, b.friction);
  AxesAcross(contact.point.normal, contact.axes[0], contact.axes[1]);
  const bool has_direction = HasDirection(a) || HasDirection(b);
  if (!has_direction && wheel == nullptr) return;
  const bool first_decides =
      HasDirection(a) &&
      (!HasDirection(b) || std::min(a.friction, a.friction2) <= std::min(b.friction, b.friction2));
  const Vector3 direction =
      has_direction ? DirectionOf(first_decides ? first : second) : wheel->forwards;
  TakeDirections(direction, std::min(a.friction, b.friction), std::min(a.friction2, b.friction2),
                 contact);
  if (!(contact.friction > 0)) return;
  contact.slip = {a.slip + b.slip, a.slip2 + b.slip2};
  if (wheel != nullptr) AddSlip(*wheel, contact);
}

}  // namespace gsv::dynamics
