#include "gsv/sensing/rays/sectors.h"

#include <emmintrin.h>

namespace gsv::sensing {
namespace {

using geometry::Bounds;
using geometry::Pose;
using geometry::Quaternion;
using geometry::Vector3;

// Boxes and sectors are extended by this, which is more than their rounding errors.
constexpr double kGrown = 1e-6;        // m, and a fraction of the distance
constexpr double kWidened = 1e-7;      // rad
constexpr double kInTheMiddle = 1e-3;  // m: a solid that is nearer than this covers all directions

// A rotation by its columns, which are the images of the x, y and z axes.
struct Rotation {
  Vector3 x, y, z;

  explicit Rotation(const Quaternion& q)
      : x{1 - 2 * (q.y * q.y + q.z * q.z), 2 * (q.x * q.y + q.w * q.z),
          2 * (q.x * q.z - q.w * q.y)},
        y{2 * (q.x * q.y - q.w * q.z), 1 - 2 * (q.x * q.x + q.z * q.z),
          2 * (q.y * q.z + q.w * q.x)},
        z{2 * (q.x * q.z + q.w * q.y), 2 * (q.y * q.z - q.w * q.x),
          1 - 2 * (q.x * q.x + q.y * q.y)} {}

  Vector3 operator*(const Vector3& v) const { return v.x * x + v.y * y + v.z * z; }
};

// A point in the fan's plane, as coordinates along `ahead` and perpendicular to it (left), both
// multiplied by the length of `ahead` in that plane.
struct Turned {
  double along, across;

  Turned(const Vector3& ahead, const Vector3& p)
      : along(ahead.x * p.x + ahead.y * p.y), across(ahead.x * p.y - ahead.y * p.x) {}
};

double LengthOf(double x, double y) { return std::sqrt(x * x + y * y); }

// The error is at most 2e-8 for x in [-1, 1].
// Source  M. Abramowitz, I. Stegun, "Handbook of mathematical functions", 1964, 4.4.49.
double QuickArcTangent(double x) {
  const double s = x * x;
  return x *
         (1 +
          s * (-0.3333314528 +
               s * (0.1999355085 +
                    s * (-0.1420889944 +
                         s * (0.1065626393 + s * (-0.0752896400 +
                                                  s * (0.0429096138 + s * (-0.0161657367 +
                                                                           s * 0.0028662257))))))));
}

// QuickAngle() returns the angle with the given tangent, and QuickAzimuth() the azimuth of (x, y).
// Both have the error of QuickArcTangent().
double QuickAngle(double tangent) {
  if (std::abs(tangent) <= 1) return QuickArcTangent(tangent);
  return std::copysign(std::numbers::pi / 2, tangent) - QuickArcTangent(1 / tangent);
}
double QuickAzimuth(double x, double y) {
  if (std::abs(y) > std::abs(x)) {
    return std::copysign(std::numbers::pi / 2, y) - QuickArcTangent(x / y);
  }
  const double from_axis = QuickArcTangent(y / x);
  return x > 0 ? from_axis : from_axis + std::copysign(std::numbers::pi, y);
}

}  // namespace

std::optional<Sector> SectorOf(const Fan& fan, const Pose& box_from_fan, const Bounds& box) {
  const Vector3& origin = box_from_fan.position;
  const Vector3 to_nearest = {std::clamp(origin.x, box.min.x, box.max.x) - origin.x,
                              std::clamp(origin.y, box.min.y, box.max.y) - origin.y,
                              std::clamp(origin.z, box.min.z, box.max.z) - origin.z};
  const double distance = Norm(to_nearest);
  const double grown =
      kGrown * (1 + distance + std::abs(origin.x) + std::abs(origin.y) + std::abs(origin.z));
  if (distance > fan.max_distance + grown) return std::nullopt;

  // The box in the fan's frame: its centre, and its half extents enlarged by `grown`.
  const Rotation fan_from_box(Inverse(box_from_fan.orientation));
  const Vector3 middle = fan_from_box * (0.5 * (box.min + box.max) - origin);
  const Vector3 half = 0.5 * (box.max - box.min) + Vector3{grown, grown, grown};
  const Vector3 a = half.x * fan_from_box.x;
  const Vector3 b = half.y * fan_from_box.y;
  const Vector3 c = half.z * fan_from_box.z;

  // From the origin to the far end of the box, the rays go from height 0 to this height.
  double height = 0;
  if (fan.elevation != 0) {
    const double far = LengthOf(middle.x, middle.y) + std::abs(a.x) + std::abs(b.x) +
                       std::abs(c.x) + std::abs(a.y) + std::abs(b.y) + std::abs(c.y);
    height = far * std::tan(fan.elevation);
  }
  const double up = std::abs(a.z) + std::abs(b.z) + std::abs(c.z);
  if (middle.z - up > std::max(0.0, height) || middle.z + up < std::min(0.0, height)) {
    return std::nullopt;
  }

  Sector sector;
  sector.nearest = std::max(0.0, distance - grown);
  const Vector3 ahead = fan_from_box * to_nearest;
  const double ahead_length = LengthOf(ahead.x, ahead.y);
  if (ahead_length < kInTheMiddle) {
    sector.is_all = true;
    return sector;
  }
  const Turned at(ahead, middle), to_a(ahead, a), to_b(ahead, b), to_c(ahead, c);
  const double least_along =
      at.along - std::abs(to_a.along) - std::abs(to_b.along) - std::abs(to_c.along);
  if (least_along <= kInTheMiddle * ahead_length) {
    sector.is_all = true;
    return sector;
  }
  // The tangents of the corners' azimuths relative to the nearest point. Two corners are processed
  // at a time.
  __m128d least = _mm_setzero_pd(), most = _mm_setzero_pd();
  const __m128d c_along = _mm_set_pd(to_c.along, -to_c.along);
  const __m128d c_across = _mm_set_pd(to_c.across, -to_c.across);
  const auto include = [&](double along, double across) {
    const __m128d tangent = (_mm_set1_pd(across) + c_across) / (_mm_set1_pd(along) + c_along);
    least = _mm_min_pd(least, tangent);
    most = _mm_max_pd(most, tangent);
  };
  include(at.along + to_a.along + to_b.along, at.across + to_a.across + to_b.across);
  include(at.along + to_a.along - to_b.along, at.across + to_a.across - to_b.across);
  include(at.along - to_a.along + to_b.along, at.across - to_a.across + to_b.across);
  include(at.along - to_a.along - to_b.along, at.across - to_a.across - to_b.across);
  const double azimuth = QuickAzimuth(ahead.x, ahead.y);
  sector.from = azimuth + QuickAngle(std::min(least[0], least[1])) - kWidened;
  sector.to = azimuth + QuickAngle(std::max(most[0], most[1])) + kWidened;
  return sector;
}

}  // namespace gsv::sensing
