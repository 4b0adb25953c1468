// Motion in the plane at a constant twist: closed form.
//
// A base that moves at (vx, vy) in its own frame while it turns at w follows a circular arc. With
// a = w t, its displacement in the frame it starts in is
//   x = (vx sin a - vy (1 - cos a)) / w,   y = (vx (1 - cos a) + vy sin a) / w.
//
// Units  metres, radians, seconds.
#pragma once

#include <cmath>

#include "gsv/geometry/vector3.h"

namespace gsv::dynamics {

// A position in the plane and a heading, as the heading's cosine and sine.
struct PlanarPosition {
  double x = 0, y = 0;
  double cosine = 1, sine = 0;
  friend bool operator==(const PlanarPosition&, const PlanarPosition&) = default;
};

// Where a point given in the base's frame is.
inline geometry::Vector2 PointAt(geometry::Vector2 point, const PlanarPosition& at) {
  return {at.x + (at.cosine * point.x - at.sine * point.y),
          at.y + (at.sine * point.x + at.cosine * point.y)};
}

// Of a point of the base, in the base's frame.
struct Twist {
  double x = 0, y = 0;  // m/s forward, to the left
  double angular = 0;   // rad/s counter-clockwise
  friend bool operator==(const Twist&, const Twist&) = default;
};

inline bool Moves(const Twist& twist) { return twist.x != 0 || twist.y != 0 || twist.angular != 0; }

// Where a base that starts at `from` is after `seconds`.
inline PlanarPosition Advance(const PlanarPosition& from, const Twist& twist, double seconds) {
  double forward = twist.x * seconds, left = twist.y * seconds;
  PlanarPosition to = from;
  if (twist.angular != 0) {
    // By the half angle: 1 - cos a = 2 sin² (a/2) does not cancel where a is small.
    const double angle = twist.angular * seconds;
    const double half_sine = std::sin(angle / 2), half_cosine = std::cos(angle / 2);
    const double sine = 2 * half_sine * half_cosine;
    const double one_less_cosine = 2 * half_sine * half_sine;
    const double cosine = 1 - one_less_cosine;
    const bool tiny = std::abs(angle) < 1e-8;
    const double straight = tiny ? 1 : sine / angle;
    const double sideways = tiny ? angle / 2 : one_less_cosine / angle;
    const double x = forward * straight - left * sideways;
    left = forward * sideways + left * straight;
    forward = x;
    to.cosine = from.cosine * cosine - from.sine * sine;
    to.sine = from.sine * cosine + from.cosine * sine;
  }
  to.x = from.x + (from.cosine * forward - from.sine * left);
  to.y = from.y + (from.sine * forward + from.cosine * left);
  return to;
}

}  // namespace gsv::dynamics
