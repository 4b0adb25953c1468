// Computes motion in the plane at a constant twist, in closed form.
//
// A base that moves at (vx, vy) in its own frame while it turns at w follows a circular arc. With a
// = w t, the base's displacement, in the base's frame at the start, is
//   x = (vx sin a - vy (1 - cos a)) / w,   y = (vx (1 - cos a) + vy sin a) / w.
//
// Units  metres, radians, seconds.
#pragma once

#include <cmath>

#include "gsv/geometry/vector3.h"

namespace gsv::geometry {

// The sine and cosine of an angle. For small angles, a series is used. It is several times faster
// than the functions of the library, because it needs no argument reduction. The first omitted term
// of the series is below 2^-68 of the result.
struct SineCosine {
  explicit SineCosine(double angle) {
    if (!(std::abs(angle) < 0.125)) {
      sine = std::sin(angle), cosine = std::cos(angle);
      return;
    }
    const double q = angle * angle;
    // The nested form of the series: 1 - q / (2·3) (1 - q / (4·5) (…)) and 1 - q / (1·2) (1 - q /
    // (3·4) (…)).
    double s = 1 - q * (1.0 / 110);
    s = 1 - q * (1.0 / 72) * s;
    s = 1 - q * (1.0 / 42) * s;
    s = 1 - q * (1.0 / 20) * s;
    sine = angle - angle * (q * (1.0 / 6) * s);
    double c = 1 - q * (1.0 / 132);
    c = 1 - q * (1.0 / 90) * c;
    c = 1 - q * (1.0 / 56) * c;
    c = 1 - q * (1.0 / 30) * c;
    c = 1 - q * (1.0 / 12) * c;
    cosine = 1 - q * 0.5 * c;
  }
  double sine = 0, cosine = 1;
};

// A position in the plane and a heading. The heading is stored as its cosine and sine.
struct PlanarPosition {
  double x = 0, y = 0;          // m
  double cosine = 1, sine = 0;  // cosine and sine of the heading, the angle from the x axis

  // Scales the heading to length 1. Before the call, its length may differ from 1 only by rounding
  // errors.
  void Normalize() {
    const double correction = 1.5 - 0.5 * (cosine * cosine + sine * sine);
    cosine *= correction, sine *= correction;
  }

  friend bool operator==(const PlanarPosition&, const PlanarPosition&) = default;
};

// Returns the position in the world of a point that is given in the base's frame.
inline Vector2 PointAt(Vector2 point, const PlanarPosition& at) {
  return {at.x + (at.cosine * point.x - at.sine * point.y),
          at.y + (at.sine * point.x + at.cosine * point.y)};
}

// The velocity of a point of the base, in the base's frame.
struct Twist {
  double x = 0, y = 0;  // velocity forward and to the left, m/s
  double angular = 0;   // angular velocity, counter-clockwise, rad/s
  friend bool operator==(const Twist&, const Twist&) = default;
};

inline bool Moves(const Twist& twist) { return twist.x != 0 || twist.y != 0 || twist.angular != 0; }

// Returns the position after `seconds` of a base that starts at `from`.
inline PlanarPosition Advance(const PlanarPosition& from, const Twist& twist, double seconds) {
  double forward = twist.x * seconds, left = twist.y * seconds;
  PlanarPosition to = from;
  if (twist.angular != 0) {
    // The half angle is used, because 1 - cos a = 2 sin² (a/2) loses no digits if a is small.
    const double angle = twist.angular * seconds;
    const SineCosine half(angle / 2);
    const double sine = 2 * half.sine * half.cosine;
    const double one_less_cosine = 2 * half.sine * half.sine;
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

}  // namespace gsv::geometry
