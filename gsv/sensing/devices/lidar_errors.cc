#include "gsv/sensing/devices/lidar_errors.h"

#include <algorithm>
#include <cmath>

#include "gsv/geometry/constants.h"

namespace gsv::sensing {
namespace {

using geometry::kInfinity;

constexpr double kMaxTangent = 20;  // the tangent at a grazing angle of 3 degrees
// two ranges that differ by more than this (m) plus a tenth of the range belong to different
// surfaces
constexpr double kEdge = 0.1;

// The tangent of the angle of incidence, from the adjacent beams that hit the same surface.
double TangentAt(double before, double range, double after, double step) {
  const bool has_before = std::abs(before - range) < kEdge + 0.1 * range;
  const bool has_after = std::abs(after - range) < kEdge + 0.1 * range;
  double slope = 0;
  if (has_before && has_after) {
    slope = (after - before) / (2 * step);
  } else if (has_before) {
    slope = (range - before) / step;
  } else if (has_after) {
    slope = (after - range) / step;
  }
  return std::min(std::abs(slope) / std::max(range, 1e-6), kMaxTangent);
}

}  // namespace

LidarErrors ReadLidarErrors(ParameterReader& reader) {
  LidarErrors errors;
  errors.range_noise = reader.Number("range_noise", 0, 0, 1);
  errors.incidence_noise = reader.Number("incidence_noise", 0, 0, 10);
  errors.beam_divergence = reader.Number("beam_divergence", 0, 0, 0.5);
  errors.reach = reader.Number("reach", 0, 0, 1e6);
  errors.short_probability = reader.Number("short_probability", 0, 0, 1);
  errors.short_range = reader.Number("short_range", errors.short_range, 1e-3, 1e4);
  return errors;
}

void Disturb(const LidarErrors& errors, const Sampling& sampling,
             const model::SensorDescription& description, double step, std::size_t first_beam,
             std::span<double> ranges) {
  const std::uint64_t stream =
      base::StableId(sampling.robot().name + "/" + description.name + "/errors");
  const auto now = static_cast<std::uint64_t>(sampling.snapshot()->state.step);
  const double covered = step > 0 ? std::min(1.0, errors.beam_divergence / std::abs(step)) : 0;
  const std::vector<double> exact(ranges.begin(), ranges.end());
  for (std::size_t i = 0; i < exact.size(); ++i) {
    base::Noise noise(sampling.seed(), stream + (first_beam + i + 1) * 0x9E3779B97F4A7C15u, now);
    const double white = noise.Gaussian(), edge = noise.Uniform(), part = noise.Uniform();
    const double strike = noise.Uniform(), nearer = noise.Uniform(), fading = noise.Gaussian();
    double range = exact[i];
    if (strike < errors.short_probability) {
      const double shorter = -errors.short_range * std::log(1 - nearer);
      if (shorter < range) {
        ranges[i] = shorter;
        continue;
      }
    }
    if (range == kInfinity) continue;
    const double before = i > 0 ? exact[i - 1] : range;
    const double after = i + 1 < exact.size() ? exact[i + 1] : range;
    const double tangent = step > 0 ? TangentAt(before, range, after, step) : 0;
    if (errors.reach > 0) {
      // At ranges near the reach, chance decides whether an echo is lost. The standard deviation of
      // the limit is 5 %.
      const double reach = errors.reach * std::pow(1 + tangent * tangent, -0.25);
      if (range > reach * (1 + 0.05 * fading)) {
        ranges[i] = kInfinity;
        continue;
      }
    }
    // Chooses one of the two adjacent beams at random. If there is an edge between this beam and
    // the chosen one, this beam covers the edge with the probability `covered`.
    const double other = edge < 0.5 ? before : after;
    if (std::isfinite(other) && std::abs(other - range) > kEdge + 0.1 * range &&
        std::abs(2 * edge - (edge < 0.5 ? 0.5 : 1.5)) < covered / 2) {
      range += part * (other - range);
    }
    const double deviation =
        std::hypot(errors.range_noise * range, errors.incidence_noise * tangent);
    ranges[i] = range + deviation * white;
  }
}

}  // namespace gsv::sensing
