// One coordinate of a ray, for clipping between two planes.
#pragma once

#include <algorithm>
#include <cmath>

namespace gsv::sensing {

// The x, y or z coordinate of a ray as a function of the distance.
struct RayAxis {
  double origin, direction;  // coordinate of the ray's origin, and of its unit direction
  double inverse;   // reciprocal of the direction; finite, because 0 times infinity is undefined
  bool is_falling;  // whether the coordinate decreases along the ray

  RayAxis(double o, double d)
      : origin(o),
        direction(d),
        inverse(std::abs(d) > 1e-100 ? 1 / d : std::copysign(1e100, d)),
        is_falling(std::signbit(d)) {}

  // The coordinate of the point at `distance` along the ray.
  double At(double distance) const { return origin + distance * direction; }
  // Returns the distance along the ray at which the ray reaches the coordinate. If the ray is
  // nearly perpendicular to the axis, the result is huge and may have either sign.
  double Reaches(double coordinate) const { return (coordinate - origin) * inverse; }
  // Clips the interval [begin, end] of the ray to the part between two coordinates.
  void Clip(double low, double high, double& begin, double& end) const {
    const double to_low = Reaches(low), to_high = Reaches(high);
    begin = std::max(begin, std::min(to_low, to_high));
    end = std::min(end, std::max(to_low, to_high));
  }
};

}  // namespace gsv::sensing
