#include "gsv/dynamics/people/social_force.h"

#include <algorithm>
#include <cmath>

namespace gsv::dynamics {
namespace {

using geometry::Vector2;

constexpr double kWallStrength = 10, kWallRange = 0.2;  // m²/s², m

double Length(Vector2 v) { return std::sqrt(v.x * v.x + v.y * v.y); }

}  // namespace

Vector2 Apart(Vector2 between, double radius, double other_radius) {
  const double length = Length(between);
  const double thicker = radius + other_radius - 2 * kPaperRadius;
  const double wanted = std::max(kClosest, length - thicker);
  return length > 0 ? (wanted / length) * between : Vector2{wanted, 0};
}

Vector2 RepulsionByOther(Vector2 apart, Vector2 other_velocity) {
  const Vector2 stride = kStride * other_velocity, beyond = apart - stride;
  const double near = Length(apart), far = Length(beyond), step = Length(stride);
  const double sum = near + far;
  const double b = 0.5 * std::sqrt(std::max(sum * sum - step * step, kMinSquare));
  // grad b = sum / (4 b) (r / |r| + (r - s) / |r - s|).
  Vector2 direction = (1 / near) * apart;
  if (far > kNoLength) direction = direction + (1 / far) * beyond;
  const double strength = kOtherStrength / kOtherRange * std::exp(-b / kOtherRange) * sum / (4 * b);
  const Vector2 force = strength * direction;
  static const double cosine = std::cos(kAside), sine = std::sin(kAside);
  return {cosine * force.x - sine * force.y, sine * force.x + cosine * force.y};
}

Vector2 AsSeen(Vector2 force, Vector2 wanted) {
  static const double cosine = std::cos(kHalfSight);
  const double ahead = -(force.x * wanted.x + force.y * wanted.y);
  return ahead >= cosine * Length(force) ? force : kUnseen * force;
}

Vector2 RepulsionByWall(Vector2 away, double distance) {
  return (kWallStrength / kWallRange * std::exp(-std::max(0.0, distance) / kWallRange)) * away;
}

double Relaxation(double seconds) { return std::exp(-seconds / kRelaxationTime); }

Vector2 NextVelocity(Vector2 velocity, Vector2 wanted, Vector2 force, double speed, double seconds,
                     double left) {
  Vector2 next = wanted + left * (velocity - wanted) + seconds * force;
  const double length = Length(next), limit = kMaxSpeedFactor * speed;
  if (length > limit) next = (limit / length) * next;
  return next;
}

}  // namespace gsv::dynamics
