#include "gsv/sensing/fan.h"

namespace gsv::sensing {
namespace {

using geometry::Bounds;
using geometry::Pose;
using geometry::Quaternion;
using geometry::Vector3;

// Boxes and sectors are taken wider by so much, which is more than rounding moves them.
constexpr double kGrown = 1e-6;        // m, and part of the distance
constexpr double kWidened = 1e-7;      // rad
constexpr double kInTheMiddle = 1e-3;  // m: nearer than this a solid is on all sides

}  // namespace

std::optional<Sector> SectorOf(const Fan& fan, const Pose& box_from_fan, const Bounds& box) {
  const Vector3& origin = box_from_fan.position;
  const Vector3 to_nearest = {std::clamp(origin.x, box.min.x, box.max.x) - origin.x,
                              std::clamp(origin.y, box.min.y, box.max.y) - origin.y,
                              std::clamp(origin.z, box.min.z, box.max.z) - origin.z};
  const double distance = Norm(to_nearest);
  const double grown = kGrown * (1 + distance + Norm(origin));
  if (distance > fan.max_distance + grown) return std::nullopt;

  // The box in the fan's frame: its middle and half of its edges.
  const Quaternion fan_from_box = Inverse(box_from_fan.orientation);
  const Vector3 middle = fan_from_box * (0.5 * (box.min + box.max) - origin);
  const Vector3 half = 0.5 * (box.max - box.min) + Vector3{grown, grown, grown};
  const Vector3 a = half.x * (fan_from_box * Vector3{1, 0, 0});
  const Vector3 b = half.y * (fan_from_box * Vector3{0, 1, 0});
  const Vector3 c = half.z * (fan_from_box * Vector3{0, 0, 1});

  // The rays go from height 0 to that above the box's far end.
  const double far = std::hypot(middle.x, middle.y) + std::abs(a.x) + std::abs(b.x) +
                     std::abs(c.x) + std::abs(a.y) + std::abs(b.y) + std::abs(c.y);
  const double height = far * std::tan(fan.elevation);
  const double up = std::abs(a.z) + std::abs(b.z) + std::abs(c.z);
  if (middle.z - up > std::max(0.0, height) || middle.z + up < std::min(0.0, height)) {
    return std::nullopt;
  }

  Sector sector;
  sector.nearest = std::max(0.0, distance - grown);
  const Vector3 ahead = fan_from_box * to_nearest;
  const double ahead_length = std::hypot(ahead.x, ahead.y);
  if (ahead_length < kInTheMiddle) {
    sector.is_all = true;
    return sector;
  }
  // Tangents of the corners' azimuths against that of the nearest point.
  double least = 0, most = 0;
  for (int corner = 0; corner < 8; ++corner) {
    const Vector3 p =
        middle + (corner & 1 ? a : -a) + (corner & 2 ? b : -b) + (corner & 4 ? c : -c);
    const double along = ahead.x * p.x + ahead.y * p.y;
    const double across = ahead.x * p.y - ahead.y * p.x;
    if (along <= kInTheMiddle * ahead_length) {
      sector.is_all = true;
      return sector;
    }
    least = std::min(least, across / along);
    most = std::max(most, across / along);
  }
  const double azimuth = std::atan2(ahead.y, ahead.x);
  sector.from = azimuth + std::atan(least) - kWidened;
  sector.to = azimuth + std::atan(most) + kWidened;
  return sector;
}

}  // namespace gsv::sensing
