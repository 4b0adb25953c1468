#include "gsv/sensing/devices/sound_cone.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <tuple>

#include "gsv/geometry/constants.h"

namespace gsv::sensing {
namespace {

using geometry::Vector3;

using geometry::kPi;
constexpr double kSpeedOfSound = 343;  // in air at 20 degrees Celsius, m/s
constexpr double kMaxConeAngle = 0.6;  // wider beams are cut off at this angle, rad
constexpr int kMaxRings = 24;
constexpr double kMaxSpacing = 0.1;  // rad

}  // namespace

SoundSettings ReadSound(ParameterReader& reader) {
  SoundSettings sound;
  sound.radius = reader.Number("transducer_radius", sound.radius, 1e-3, 1);
  sound.frequency = reader.Number("frequency", sound.frequency, 1e3, 1e6);
  sound.threshold = reader.Number("threshold", sound.threshold, 1e-4, 1);
  sound.specular_width = reader.Number("specular_width", sound.specular_width, 0.01, 1);
  sound.roughness = reader.Number("roughness", sound.roughness, 0, 1);
  sound.gain_range = reader.Number("gain_range", sound.gain_range, 0, 1e4);
  sound.target_size = reader.Flag("target_size", sound.target_size);
  sound.second_reflections = reader.Flag("second_reflections", sound.second_reflections);
  sound.firing_slot = reader.Count("firing_slot", sound.firing_slot, 0, 1000);
  return sound;
}

double Directivity(const SoundSettings& sound, double angle) {
  const double x =
      2 * kPi * sound.frequency / kSpeedOfSound * sound.radius * std::sin(std::abs(angle));
  return x < 1e-6 ? 1 : 2 * std::cyl_bessel_j(1.0, x) / x;
}

SoundCone::SoundCone(const SoundSettings& sound)
    : sound_(sound),
      spacing_(std::clamp(sound.specular_width, kMaxConeAngle / kMaxRings, kMaxSpacing)) {
  // The beams are rings of rays. The rays are so close to each other that one of them is nearly
  // perpendicular to any surface.
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
                              double max_distance, std::span<const Sender> others) const {
  std::vector<Ray> rays;
  rays.reserve(beams_.size());
  for (const Beam& beam : beams_) {
    rays.push_back(
        {world_from_sonar.position, world_from_sonar.orientation * beam.direction, max_distance});
  }
  std::vector<std::optional<Hit>> hits(rays.size());
  sampling.Rays().Cast(rays, sampling.body(), hits);
  std::vector<Echo> echoes;
  std::map<int, std::size_t> nearest_of;  // index in `rays`, by body
  for (std::size_t i = 0; i < rays.size(); ++i) {
    if (!hits[i]) continue;
    const double strength = EchoOf(rays[i], *hits[i], beams_[i].strength);
    if (IsHeard(strength, hits[i]->distance)) {
      echoes.push_back({hits[i]->distance, strength, rays[i], *hits[i]});
    }
    const auto [known, is_new] = nearest_of.emplace(hits[i]->body, i);
    if (!is_new && hits[i]->distance < hits[known->second]->distance) known->second = i;
  }
  const Vector3 axis = world_from_sonar.orientation * Vector3{1, 0, 0};
  for (const auto& [body, place] : nearest_of) {
    const Echo echo = EchoNear(sampling, rays[place], *hits[place], axis);
    if (IsHeard(echo.strength, echo.distance)) echoes.push_back(echo);
  }
  if (sound_.second_reflections) {
    AddSecondReflections(sampling, rays, hits, max_distance, echoes);
  }
  for (const Sender& sender : others) AddCrosstalk(sender, rays, hits, echoes);
  return NearestHeard(sampling, std::move(echoes));
}

double SoundCone::NearestHeard(const Sampling& sampling, std::vector<Echo> echoes) const {
  if (!sound_.target_size) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const Echo& echo : echoes) nearest = std::min(nearest, echo.distance);
    return nearest;
  }
  std::sort(echoes.begin(), echoes.end(), [](const Echo& a, const Echo& b) {
    return std::tie(a.distance, b.strength) < std::tie(b.distance, a.strength);
  });
  // Echoes that are at most this fraction farther than the nearest of them count as one target. The
  // strongest of them decides whether the sonar detects the target. The measured distance is that
  // of the nearest.
  constexpr double kOneTarget = 0.02;  // fraction of the distance
  constexpr int kMaxTargets = 6;
  int targets = 0;
  for (std::size_t i = 0; i < echoes.size() && targets < kMaxTargets; ++targets) {
    Echo strongest = echoes[i];
    const double end = echoes[i].distance * (1 + kOneTarget);
    const double nearest = echoes[i].distance;
    for (; i < echoes.size() && echoes[i].distance <= end; ++i) {
      if (echoes[i].strength > strongest.strength) strongest = echoes[i];
    }
    if (IsHeard(strongest.strength * FilledPart(sampling, strongest), strongest.distance)) {
      return nearest;
    }
  }
  return std::numeric_limits<double>::infinity();
}

double SoundCone::FilledPart(const Sampling& sampling, const Echo& echo) const {
  constexpr int kHalvings = 4;
  const double wave_length = kSpeedOfSound / sound_.frequency;
  const double distance = echo.hit.distance;
  const double half = std::sqrt(wave_length * distance / 2) / 2;
  const Ray& ray = echo.ray;
  const Vector3 aside = geometry::Normalized(
      Cross(ray.direction, std::abs(ray.direction.z) < 0.9 ? Vector3{0, 0, 1} : Vector3{1, 0, 0}));
  const Vector3 across = Cross(ray.direction, aside);
  const Vector3 middle = distance * ray.direction;
  // Returns the distance over which the surface deviates by less than an eighth of a wave length
  // from the plane perpendicular to the sound's path.
  const auto extent = [&](const Vector3& way) {
    const auto is_filled = [&](double offset) {
      const Vector3 there = middle + offset * way;
      const double length = Norm(there);
      const auto hit = sampling.Rays().Cast(
          {ray.origin, (1 / length) * there, length + wave_length}, sampling.body());
      return hit && hit->body == echo.hit.body &&
             std::abs(hit->distance - length) < wave_length / 8;
    };
    if (is_filled(half)) return half;
    double within = 0, beyond = half;
    for (int i = 0; i < kHalvings; ++i) {
      const double between = (within + beyond) / 2;
      (is_filled(between) ? within : beyond) = between;
    }
    return (within + beyond) / 2;
  };
  const double width = extent(aside) + extent(-aside), height = extent(across) + extent(-across);
  return width * height / (4 * half * half);
}

void SoundCone::AddSecondReflections(const Sampling& sampling, std::span<const Ray> rays,
                                     std::span<const std::optional<Hit>> hits, double max_distance,
                                     std::vector<Echo>& echoes) const {
  constexpr double kOffTheSurface = 1e-6;
  // Angle between the sound and the normal, rad. Below this angle, the first echo returns to the
  // sonar, so no second reflection is needed.
  constexpr double kOblique = 0.2;
  std::vector<Ray> mirrored;
  std::vector<std::size_t> places;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    if (!hits[i] || beams_[i].strength < sound_.threshold) continue;
    const Vector3& direction = rays[i].direction;
    const double cosine = -Dot(direction, hits[i]->normal);
    if (cosine > std::cos(kOblique) || hits[i]->distance >= max_distance) continue;
    const Vector3 onward = direction + 2 * cosine * hits[i]->normal;
    mirrored.push_back(
        {rays[i].origin + hits[i]->distance * direction + kOffTheSurface * hits[i]->normal, onward,
         max_distance - hits[i]->distance});
    places.push_back(i);
  }
  std::vector<std::optional<Hit>> seconds(mirrored.size());
  sampling.Rays().Cast(mirrored, sampling.body(), seconds);
  const double once = 1 - sound_.roughness;
  for (std::size_t i = 0; i < mirrored.size(); ++i) {
    if (!seconds[i]) continue;
    const std::size_t place = places[i];
    const Vector3& out = rays[place].direction;
    const Vector3& onward = mirrored[i].direction;
    const double cosine = std::clamp(-Dot(onward, seconds[i]->normal), -1.0, 1.0);
    // The sound can return in two ways. If the second surface is perpendicular to the sound, the
    // sound returns along the same path, over the first surface. If the two surfaces form a corner,
    // the sound goes from the second surface directly to the sensor, beside its outward path.
    const double same_way = once * once * Mirrored(std::acos(cosine));
    const Vector3 home = onward + 2 * cosine * seconds[i]->normal;
    const double corner = once * Mirrored(std::acos(std::clamp(-Dot(home, out), -1.0, 1.0)) / 2);
    const double first = hits[place]->distance, second = seconds[i]->distance;
    const double whole = first + second;
    // From a corner, the last leg of the path is from the second surface to the sensor. Half of the
    // total path is the distance to the edge of the corner.
    const double by_corner = first + second * (1 + Dot(out, onward)) / 2;
    const double strength = beams_[place].strength * std::max(same_way, corner);
    const double distance = same_way >= corner ? whole : by_corner;
    if (distance <= max_distance && IsHeard(strength, distance)) {
      echoes.push_back({distance, strength, mirrored[i], *seconds[i]});
    }
  }
}

void SoundCone::AddCrosstalk(const Sender& sender, std::span<const Ray> rays,
                             std::span<const std::optional<Hit>> hits,
                             std::vector<Echo>& echoes) const {
  static const double kMinCosine = std::cos(kMaxConeAngle);
  const Vector3 axis = sender.world_from_sonar.orientation * Vector3{1, 0, 0};
  for (std::size_t i = 0; i < rays.size(); ++i) {
    if (!hits[i]) continue;
    const Vector3 place = rays[i].origin + hits[i]->distance * rays[i].direction;
    const Vector3 way = place - sender.world_from_sonar.position;
    const double length = Norm(way);
    if (length < 1e-6) continue;
    const Vector3 out = (1 / length) * way;
    const double along = Dot(out, axis);
    if (along < kMinCosine) continue;  // the point is outside of the sender's lobe
    const double heard = std::sqrt(beams_[i].strength);
    const Vector3 half = geometry::Normalized(out + rays[i].direction);
    const double cosine = std::clamp(-Dot(half, hits[i]->normal), -1.0, 1.0);
    const double returned = heard * ((1 - sound_.roughness) * Mirrored(std::acos(cosine)) +
                                     sound_.roughness * std::max(cosine, 0.0));
    const double distance = (length + hits[i]->distance) / 2;
    // the echo would not be detected even on the sender's axis
    if (!IsHeard(returned, distance)) continue;
    const double strength =
        returned * std::abs(Directivity(sender.sound, std::acos(std::min(along, 1.0))));
    if (IsHeard(strength, distance)) echoes.push_back({distance, strength, rays[i], *hits[i]});
  }
}

bool SoundCone::IsHeard(double strength, double distance) const {
  const double beyond = sound_.gain_range > 0 ? std::max(1.0, distance / sound_.gain_range) : 1.0;
  return strength >= sound_.threshold * beyond;
}

double SoundCone::Mirrored(double angle) const {
  const double off = angle / sound_.specular_width;
  return std::exp(-off * off / 2);
}

double SoundCone::EchoOf(const Ray& ray, const Hit& hit, double strength) const {
  const double cosine = std::clamp(-Dot(ray.direction, hit.normal), -1.0, 1.0);
  return strength * ((1 - sound_.roughness) * Mirrored(std::acos(cosine)) +
                     sound_.roughness * std::max(cosine, 0.0));
}

SoundCone::Echo SoundCone::EchoNear(const Sampling& sampling, Ray ray, Hit hit,
                                    const Vector3& axis) const {
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
  return {hit.distance, EchoOf(ray, hit, strength), ray, hit};
}

}  // namespace gsv::sensing
