#include "gsv/sensing/drift.h"

#include <cmath>

#include "gsv/base/random.h"

namespace gsv::sensing {
namespace {

constexpr double kBlock = 64;  // interval length, in correlation times
constexpr int kHalvings = 16;  // intervals are halved down to a thousandth of the correlation time

}  // namespace

double DriftAt(base::SimTime time, double correlation_time, std::uint64_t seed,
               std::uint64_t stream) {
  const double blocks = base::ToSeconds(time) / (kBlock * correlation_time);
  const double block = std::floor(blocks);
  const auto draw = [&](double of_block, std::uint64_t node) {
    const std::uint64_t number = static_cast<std::uint64_t>(of_block) << (kHalvings + 1);
    return base::Noise(seed, stream, number + node).Gaussian();
  };
  double first = draw(block, 0), last = draw(block + 1, 0);
  double place = blocks - block;  // position in the interval, as a fraction in [0, 1)
  double length = kBlock;         // length of the interval, in correlation times
  std::uint64_t node = 1;         // number of the interval, counted like a node of a binary heap
  for (int i = 0; i < kHalvings; ++i) {
    length /= 2;
    const double rho = std::exp(-length);
    const double middle = rho / (1 + rho * rho) * (first + last) +
                          std::sqrt((1 - rho * rho) / (1 + rho * rho)) * draw(block, node);
    const bool is_late = place >= 0.5;
    (is_late ? first : last) = middle;
    place = 2 * place - (is_late ? 1 : 0);
    node = 2 * node + (is_late ? 1 : 0);
  }
  return first + place * (last - first);
}

}  // namespace gsv::sensing
