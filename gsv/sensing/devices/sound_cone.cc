#include "gsv/sensing/devices/sound_cone.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>

#include "gsv/geometry/constants.h"

namespace gsv::sensing {
namespace {

using geometry::Vector3;

using geometry::kPi;
constexpr double kSpeedOfSound = 343;  // m/s, in air of 20 degrees
constexpr double kMaxConeAngle = 0.6;  // rad: what sends wider than this is cut off here
constexpr int kMaxRings = 24;

}  // namespace

SoundSettings ReadSound(ParameterReader& reader) {
  SoundSettings sound;
  sound.radius = reader.Number("transducer_radius", sound.radius, 1e-3, 1);
  sound.frequency = reader.Number("frequency", sound.frequency, 1e3, 1e6);
  sound.threshold = reader.Number("threshold", sound.threshold, 1e-4, 1);
  sound.specular_width = reader.Number("specular_width", sound.specular_width, 0.01, 1);
  sound.roughness = reader.Number("roughness", sound.roughness, 0, 1);
  return sound;
}

double Directivity(const SoundSettings& sound, double angle) {
  const double x =
      2 * kPi * sound.frequency / kSpeedOfSound * sound.radius * std::sin(std::abs(angle));
  return x < 1e-6 ? 1 : 2 * std::cyl_bessel_j(1.0, x) / x;
}

SoundCone::SoundCone(const SoundSettings& sound)
    : sound_(sound), spacing_(std::max(sound.specular_width, kMaxConeAngle / kMaxRings)) {
  // Rings of rays, close enough for one of them to be nearly perpendicular to any surface.
  beams_.push_back({{1, 0, 0}, 1});
  for (int ring = 1; ring * spacing_ <= kMaxConeAngle; ++ring) {
    const double angle = ring * spacing_;
    const double strength = std::pow(Directivity(sound, angle), 2);
    if (strength < sound.threshold) continue;
    const int count = 6 * ring;
    for (int i = 0; i < count; ++i) {
      const double around = 2 * kPi * i / count;
      beams_.push_back({{std::cos(angle), std::sin(angle) * std::cos(around),
                         std::sin(angle) * std::sin(around)},
                        strength});
    }
  }
}

double SoundCone::NearestEcho(const Sampling& sampling, const geometry::Pose& world_from_sonar,
                              double max_distance) const {
  std::vector<Ray> rays;
  rays.reserve(beams_.size());
  for (const Beam& beam : beams_) {
    rays.push_back(
        {world_from_sonar.position, world_from_sonar.orientation * beam.direction, max_distance});
  }
  std::vector<std::optional<Hit>> hits(rays.size());
  sampling.Rays().Cast(rays, sampling.body(), hits);
  double nearest = std::numeric_limits<double>::infinity();
  std::map<int, std::size_t> nearest_of;  // by body, a place in rays
  for (std::size_t i = 0; i < rays.size(); ++i) {
    if (!hits[i]) continue;
    if (EchoOf(rays[i], *hits[i], beams_[i].strength) >= sound_.threshold) {
      nearest = std::min(nearest, hits[i]->distance);
    }
    const auto [known, is_new] = nearest_of.emplace(hits[i]->body, i);
    if (!is_new && hits[i]->distance < hits[known->second]->distance) known->second = i;
  }
  const Vector3 axis = world_from_sonar.orientation * Vector3{1, 0, 0};
  for (const auto& [body, place] : nearest_of) {
    nearest = std::min(nearest, EchoNear(sampling, rays[place], *hits[place], axis));
  }
  return nearest;
}

double SoundCone::EchoOf(const Ray& ray, const Hit& hit, double strength) const {
  const double cosine = std::clamp(-Dot(ray.direction, hit.normal), -1.0, 1.0);
  const double off = std::acos(cosine) / sound_.specular_width;
  return strength * ((1 - sound_.roughness) * std::exp(-off * off / 2) +
                     sound_.roughness * std::max(cosine, 0.0));
}

double SoundCone::EchoNear(const Sampling& sampling, Ray ray, Hit hit, const Vector3& axis) const {
  for (double step = spacing_ / 2; step > spacing_ / 64; step /= 2) {
    const Vector3 aside = geometry::Normalized(Cross(
        ray.direction, std::abs(ray.direction.z) < 0.9 ? Vector3{0, 0, 1} : Vector3{1, 0, 0}));
    const Vector3 across = Cross(ray.direction, aside);
    const Ray from = ray;
    for (const Vector3& way : {aside, -aside, across, -across}) {
      Ray there = from;
      there.direction = geometry::Normalized(from.direction + step * way);
      const auto found = sampling.Rays().Cast(there, sampling.body());
      if (found && found->body == hit.body && found->distance < hit.distance) {
        ray = there, hit = *found;
      }
    }
  }
  const double angle = std::acos(std::clamp(Dot(ray.direction, axis), -1.0, 1.0));
  const double strength = std::pow(Directivity(sound_, angle), 2);
  return EchoOf(ray, hit, strength) >= sound_.threshold ? hit.distance
                                                        : std::numeric_limits<double>::infinity();
}

}  // namespace gsv::sensing
