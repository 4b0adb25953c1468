#include "gsv/sensing/rays/sectors.h"

#include "gsv/base/each_processor.h"

namespace gsv::sensing {
namespace {

using geometry::Vector3;

// Boxes are extended by kGrown, and sectors by kWidened. Both exceed the rounding errors.
constexpr double kGrown = 1e-6;        // m, and a fraction of the distance
constexpr double kWidened = 1e-7;      // rad
constexpr double kInTheMiddle = 1e-3;  // a solid that is nearer than this covers all directions, m

// The functions below have no branches, so that the compiler computes several boxes at once. The
// compiler does this only for plain comparisons, not for std::min() and std::max().

inline double Smaller(double a, double b) { return a < b ? a : b; }
inline double Larger(double a, double b) { return a > b ? a : b; }
inline double Between(double x, double low, double high) { return Smaller(Larger(x, low), high); }
inline double Square(double x) { return x * x; }

// The error is at most 2e-8 for x in [-1, 1].
// Source  M. Abramowitz, I. Stegun, "Handbook of mathematical functions", 1964, 4.4.49.
inline double QuickArcTangent(double x) {
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
inline double QuickAngle(double tangent) {
  const bool is_steep = std::abs(tangent) > 1;
  const double inverse = 1 / tangent;
  const double angle = QuickArcTangent(is_steep ? inverse : tangent);
  return is_steep ? std::copysign(std::numbers::pi / 2, tangent) - angle : angle;
}
inline double QuickAzimuth(double x, double y) {
  const bool is_steep = std::abs(y) > std::abs(x);
  const double angle = QuickArcTangent((is_steep ? x : y) / (is_steep ? y : x));
  const double if_behind = angle + std::copysign(std::numbers::pi, y);
  const double if_flat = x > 0 ? angle : if_behind;
  return is_steep ? std::copysign(std::numbers::pi / 2, y) - angle : if_flat;
}

// A point in the fan's plane. The coordinates are along `ahead` and perpendicular to it (to the
// left). Both are multiplied by the length of `ahead` in that plane.
struct Turned {
  double along, across;

  Turned(double ahead_x, double ahead_y, double x, double y)
      : along(ahead_x * x + ahead_y * y), across(ahead_x * y - ahead_y * x) {}
};

// The smallest and largest tangent of the azimuths of points. Azimuths are measured from the
// direction of the box's nearest point.
struct Tangents {
  double least = 0, most = 0;

  void Add(double along, double across) {
    const double tangent = across / along;
    least = Smaller(least, tangent);
    most = Larger(most, tangent);
  }
};

}  // namespace

GSV_FOR_EACH_PROCESSOR
void FindSectors(const Fan& fan, BoxBatch& boxes, SectorBatch& sectors) {
  const auto& [at, turn] = fan.world_from_fan;
  // The height by which the rays rise per metre of distance in the fan's plane.
  const double slope = fan.elevation != 0 ? std::tan(fan.elevation) : 0;
  const double max_distance = fan.max_distance;
  const double at_x = at.x, at_y = at.y, at_z = at.z;
  const double fw = turn.w, fx = turn.x, fy = turn.y, fz = turn.z;
  const std::size_t count = boxes.Pad() / 4 * 4;
  const BoxBatch& b = boxes;
// The arrays of the two batches do not overlap, so the loop can be vectorised.
#pragma GCC ivdep
  for (std::size_t i = 0; i < count; ++i) {
    // The fan's place in the box's frame: position + orientation * at.
    const double w = b.qw[i], x = b.qx[i], y = b.qy[i], z = b.qz[i];
    const double cx = y * at_z - z * at_y + w * at_x;
    const double cy = z * at_x - x * at_z + w * at_y;
    const double cz = x * at_y - y * at_x + w * at_z;
    const double ox = b.x[i] + at_x + 2 * (y * cz - z * cy);
    const double oy = b.y[i] + at_y + 2 * (z * cx - x * cz);
    const double oz = b.z[i] + at_z + 2 * (x * cy - y * cx);

    const double to_x = Between(ox, b.min_x[i], b.max_x[i]) - ox;
    const double to_y = Between(oy, b.min_y[i], b.max_y[i]) - oy;
    const double to_z = Between(oz, b.min_z[i], b.max_z[i]) - oz;
    const double distance = std::sqrt(Square(to_x) + Square(to_y) + Square(to_z));
    const double grown = kGrown * (1 + distance + std::abs(ox) + std::abs(oy) + std::abs(oz));

    // The rotation from the fan to the box, and the columns of its inverse.
    const double qw = w * fw - x * fx - y * fy - z * fz;
    const double qx = w * fx + x * fw + y * fz - z * fy;
    const double qy = w * fy - x * fz + y * fw + z * fx;
    const double qz = w * fz + x * fy - y * fx + z * fw;
    const double xx = 1 - 2 * (qy * qy + qz * qz), xy = 2 * (qx * qy - qw * qz);
    const double xz = 2 * (qx * qz + qw * qy);
    const double yx = 2 * (qx * qy + qw * qz), yy = 1 - 2 * (qx * qx + qz * qz);
    const double yz = 2 * (qy * qz - qw * qx);
    const double zx = 2 * (qx * qz - qw * qy), zy = 2 * (qy * qz + qw * qx);
    const double zz = 1 - 2 * (qx * qx + qy * qy);

    // The box in the fan's frame: its centre, and its half extents enlarged by `grown`.
    const double px = 0.5 * (b.min_x[i] + b.max_x[i]) - ox;
    const double py = 0.5 * (b.min_y[i] + b.max_y[i]) - oy;
    const double pz = 0.5 * (b.min_z[i] + b.max_z[i]) - oz;
    const double mx = px * xx + py * yx + pz * zx;
    const double my = px * xy + py * yy + pz * zy;
    const double mz = px * xz + py * yz + pz * zz;
    const double half_x = 0.5 * (b.max_x[i] - b.min_x[i]) + grown;
    const double half_y = 0.5 * (b.max_y[i] - b.min_y[i]) + grown;
    const double half_z = 0.5 * (b.max_z[i] - b.min_z[i]) + grown;
    const double ax = half_x * xx, ay = half_x * xy, az = half_x * xz;
    const double bx = half_y * yx, by = half_y * yy, bz = half_y * yz;
    const double dx = half_z * zx, dy = half_z * zy, dz = half_z * zz;

    // `height` is the height of the rays above the fan's plane at the far end of the box. At the
    // fan's origin, the height is 0.
    const double far = std::sqrt(mx * mx + my * my) + std::abs(ax) + std::abs(bx) + std::abs(dx) +
                       std::abs(ay) + std::abs(by) + std::abs(dy);
    const double height = far * slope;
    const double up = std::abs(az) + std::abs(bz) + std::abs(dz);
    const double highest = Larger(0, height), lowest = Smaller(0, height);

    const double ahead_x = to_x * xx + to_y * yx + to_z * zx;
    const double ahead_y = to_x * xy + to_y * yy + to_z * zy;
    const double ahead_length = std::sqrt(ahead_x * ahead_x + ahead_y * ahead_y);
    const Turned middle(ahead_x, ahead_y, mx, my), a(ahead_x, ahead_y, ax, ay);
    const Turned c(ahead_x, ahead_y, bx, by), d(ahead_x, ahead_y, dx, dy);
    const double least_along =
        middle.along - std::abs(a.along) - std::abs(c.along) - std::abs(d.along);

    // The tangents of the corners' azimuths.
    Tangents tangents;
    const double along_1 = middle.along + a.along, across_1 = middle.across + a.across;
    const double along_2 = middle.along - a.along, across_2 = middle.across - a.across;
    tangents.Add(along_1 + c.along + d.along, across_1 + c.across + d.across);
    tangents.Add(along_1 + c.along - d.along, across_1 + c.across - d.across);
    tangents.Add(along_1 - c.along + d.along, across_1 - c.across + d.across);
    tangents.Add(along_1 - c.along - d.along, across_1 - c.across - d.across);
    tangents.Add(along_2 + c.along + d.along, across_2 + c.across + d.across);
    tangents.Add(along_2 + c.along - d.along, across_2 + c.across - d.across);
    tangents.Add(along_2 - c.along + d.along, across_2 - c.across + d.across);
    tangents.Add(along_2 - c.along - d.along, across_2 - c.across - d.across);
    const double azimuth = QuickAzimuth(ahead_x, ahead_y);

    sectors.nearest[i] = Larger(0, distance - grown);
    sectors.from[i] = azimuth + QuickAngle(tangents.least) - kWidened;
    sectors.to[i] = azimuth + QuickAngle(tangents.most) + kWidened;
    const double some_or_all =
        (ahead_length < kInTheMiddle) | (least_along <= kInTheMiddle * ahead_length)
            ? SectorBatch::kAll
            : SectorBatch::kSome;
    sectors.kind[i] = (distance > max_distance + grown) | (mz - up > highest) | (mz + up < lowest)
                          ? SectorBatch::kNone
                          : some_or_all;
  }
}

}  // namespace gsv::sensing
