#include "gsv/sensing/devices/geodesy.h"

#include <cmath>

namespace gsv::sensing {
namespace {

using geometry::Vector3;

constexpr double kMajor = 6378137.0;  // semi-major axis of the ellipsoid, m
constexpr double kFlattening = 1 / 298.257223563;
constexpr double kMinor = kMajor * (1 - kFlattening);
constexpr double kEccentricity2 = kFlattening * (2 - kFlattening);
constexpr double kSecondEccentricity2 = kEccentricity2 / (1 - kEccentricity2);

}  // namespace

Vector3 EcefOf(const GeodeticPlace& place) {
  const double s = std::sin(place.latitude), c = std::cos(place.latitude);
  const double normal = kMajor / std::sqrt(1 - kEccentricity2 * s * s);
  return {(normal + place.altitude) * c * std::cos(place.longitude),
          (normal + place.altitude) * c * std::sin(place.longitude),
          (normal * (1 - kEccentricity2) + place.altitude) * s};
}

GeodeticPlace PlaceOf(const Vector3& p) {
  const double from_axis = std::hypot(p.x, p.y);
  // `reduced` is the reduced latitude: the angle of the corresponding point on the circle around
  // the ellipse.
  double reduced = std::atan2(kMajor * p.z, kMinor * from_axis);
  double latitude = 0;
  for (int i = 0; i < 4; ++i) {
    const double s = std::sin(reduced), c = std::cos(reduced);
    latitude = std::atan2(p.z + kSecondEccentricity2 * kMinor * s * s * s,
                          from_axis - kEccentricity2 * kMajor * c * c * c);
    reduced = std::atan2((1 - kFlattening) * std::sin(latitude), std::cos(latitude));
  }
  const double s = std::sin(latitude), c = std::cos(latitude);
  // The altitude is computed along the normal, which is well defined everywhere, also at the poles.
  const double altitude = from_axis * c + p.z * s - kMajor * std::sqrt(1 - kEccentricity2 * s * s);
  return {latitude, std::atan2(p.y, p.x), altitude};
}

Vector3 EastNorthUp(const model::GeodeticOrigin& origin, const Vector3& v) {
  const double c = std::cos(origin.heading), s = std::sin(origin.heading);
  return {c * v.x - s * v.y, s * v.x + c * v.y, v.z};
}

GeodeticPlace PlaceOf(const model::GeodeticOrigin& origin, const Vector3& point_in_world) {
  const Vector3 v = EastNorthUp(origin, point_in_world);
  const double s = std::sin(origin.latitude), c = std::cos(origin.latitude);
  const double sl = std::sin(origin.longitude), cl = std::cos(origin.longitude);
  const Vector3 east{-sl, cl, 0}, north{-s * cl, -s * sl, c}, up{c * cl, c * sl, s};
  return PlaceOf(EcefOf({origin.latitude, origin.longitude, origin.elevation}) + v.x * east +
                 v.y * north + v.z * up);
}

}  // namespace gsv::sensing
