#include "gsv/base/random.h"

#include <cmath>
#include <numbers>

namespace gsv::base {
namespace {

struct Product {
  std::uint32_t high;
  std::uint32_t low;
};

Product Multiply(std::uint32_t a, std::uint32_t b) {
  const std::uint64_t product = static_cast<std::uint64_t>(a) * b;
  return {static_cast<std::uint32_t>(product >> 32), static_cast<std::uint32_t>(product)};
}

std::uint64_t Mix(std::uint64_t a, std::uint64_t b) {
  const auto words =
      Philox4x32({static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(a >> 32)},
                 {static_cast<std::uint32_t>(b), static_cast<std::uint32_t>(b >> 32), 0, 0});
  return (static_cast<std::uint64_t>(words[1]) << 32) | words[0];
}

}  // namespace

std::array<std::uint32_t, 4> Philox4x32(std::array<std::uint32_t, 2> key,
                                        std::array<std::uint32_t, 4> counter) {
  for (int round = 0; round < 10; ++round) {
    const Product p0 = Multiply(0xD2511F53u, counter[0]);
    const Product p1 = Multiply(0xCD9E8D57u, counter[2]);
    counter = {p1.high ^ counter[1] ^ key[0], p1.low, p0.high ^ counter[3] ^ key[1], p0.low};
    key[0] += 0x9E3779B9u;
    key[1] += 0xBB67AE85u;
  }
  return counter;
}

std::uint64_t StableId(std::string_view name) {
  std::uint64_t hash = 0xcbf29ce484222325ull;
  for (const char c : name) {
    hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3ull;
  }
  return hash;
}

Noise::Noise(std::uint64_t seed, std::uint64_t stream, std::uint64_t step) {
  const std::uint64_t key = Mix(seed, stream);
  key_ = {static_cast<std::uint32_t>(key), static_cast<std::uint32_t>(key >> 32)};
  counter_ = {0, 0, static_cast<std::uint32_t>(step), static_cast<std::uint32_t>(step >> 32)};
}

double Noise::Uniform() {
  const auto words = Philox4x32(key_, counter_);
  ++counter_[0];
  const std::uint64_t bits = (static_cast<std::uint64_t>(words[0]) << 32 | words[1]) >> 11;
  return static_cast<double>(bits) * 0x1p-53;
}

double Noise::Gaussian() {
  const double u = 1.0 - Uniform();  // u is in (0, 1], so its logarithm is finite
  const double v = Uniform();
  return std::sqrt(-2.0 * std::log(u)) * std::cos(2.0 * std::numbers::pi * v);
}

}  // namespace gsv::base
