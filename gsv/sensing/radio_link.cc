#include "gsv/sensing/radio_link.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace gsv::sensing {
namespace {

constexpr double kSpeedOfLight = 299'792'458;  // m/s
constexpr double kNearest = 0.01;              // m
constexpr double kPastASurface = 1e-6;         // m
constexpr int kMaxCrossings = 64;

}  // namespace

double ArrivingStrength(const world::RadioSetup& sender, const world::RadioSetup& receiver,
                        double distance, int walls) {
  const double first_metre =
      20 * std::log10(4 * std::numbers::pi * sender.frequency / kSpeedOfLight);
  const double beyond = 10 * sender.path_loss_exponent * std::log10(std::max(distance, kNearest));
  return sender.power + sender.gain + receiver.gain - first_metre - beyond -
         walls * sender.wall_loss;
}

int WallsBetween(const world::RayCaster& rays, const Antenna& from, const Antenna& to) {
  const geometry::Vector3 gap = to.position - from.position;
  double left = Norm(gap);
  if (left <= kPastASurface) return 0;
  world::Ray ray{from.position, (1 / left) * gap, left};
  int crossings = 0;
  for (int i = 0; i < kMaxCrossings; ++i) {
    const auto hit = rays.Cast(ray, from.body);
    if (!hit) break;
    if (hit->body != to.body) ++crossings;
    const double step = hit->distance + kPastASurface;
    left -= step;
    if (left <= 0) break;
    ray = {ray.origin + step * ray.direction, ray.direction, left};
  }
  return (crossings + 1) / 2;
}

std::optional<double> HeardAt(const Antenna& from, const Antenna& to,
                              const world::RayCaster& rays) {
  const world::RadioSetup& sender = *from.setup;
  const world::RadioSetup& receiver = *to.setup;
  if (sender.network != receiver.network || sender.frequency != receiver.frequency) return {};
  const double distance = Norm(to.position - from.position);
  if (sender.range > 0 && distance > sender.range) return {};
  const double in_the_open = ArrivingStrength(sender, receiver, distance, 0);
  if (in_the_open < receiver.sensitivity) return {};
  if (sender.wall_loss == 0) return in_the_open;
  const double strength =
      ArrivingStrength(sender, receiver, distance, WallsBetween(rays, from, to));
  if (strength < receiver.sensitivity) return {};
  return strength;
}

}  // namespace gsv::sensing
