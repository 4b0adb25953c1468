// Counter-based random numbers: a value is a pure function of a key and a counter, so that no draw
// depends on earlier draws.
//
// Source       Philox4x32-10: Salmon, Moraes, Dror, Shaw, "Parallel random numbers: as easy as 1,
//              2, 3", SC 2011. Tests compare with the paper's published values.
// Determinism  integer arithmetic only, except Uniform(), whose conversion is exact, and
//              Gaussian(), which uses libm's log and cos.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace gsv::base {

// Returns four independent uniform 32-bit words for one (key, counter).
std::array<std::uint32_t, 4> Philox4x32(std::array<std::uint32_t, 2> key,
                                        std::array<std::uint32_t, 4> counter);

// Returns a 64-bit hash of a string, equal on every machine (FNV-1a).
std::uint64_t StableId(std::string_view name);

// The random numbers of one sensor at one step. Equal constructor arguments give equal sequences of
// numbers.
class Noise {
 public:
  // `stream` names the robot and sensor, see StableId(); `step` is the sampling step.
  Noise(std::uint64_t seed, std::uint64_t stream, std::uint64_t step);

  // Returns a number with 53 random bits, uniform in [0, 1).
  double Uniform();
  // Returns a normal number with mean 0 and standard deviation 1 (Box–Muller).
  double Gaussian();

 private:
  std::array<std::uint32_t, 2> key_;  // a hash of the seed and the stream
  // Words 0 and 1: the number of draws in this step. Words 2 and 3: the step.
  std::array<std::uint32_t, 4> counter_;
};

}  // namespace gsv::base
