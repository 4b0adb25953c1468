#include "gsv/base/random.h"

#include <cmath>

#include <gtest/gtest.h>

namespace gsv::base {
namespace {

using Words = std::array<std::uint32_t, 4>;

// The known answers published with Random123 (kat_vectors, philox4x32 10 rounds).
TEST(Philox, EqualsThePublishedKnownAnswers) {
  EXPECT_EQ(Philox4x32({0, 0}, {0, 0, 0, 0}),
            (Words{0x6627e8d5u, 0xe169c58du, 0xbc57ac4cu, 0x9b00dbd8u}));
  EXPECT_EQ(
      Philox4x32({0xffffffffu, 0xffffffffu}, {0xffffffffu, 0xffffffffu, 0xffffffffu, 0xffffffffu}),
      (Words{0x408f276du, 0x41c83b0eu, 0xa20bc7c6u, 0x6d5451fdu}));
  EXPECT_EQ(
      Philox4x32({0xa4093822u, 0x299f31d0u}, {0x243f6a88u, 0x85a308d3u, 0x13198a2eu, 0x03707344u}),
      (Words{0xd16cfe09u, 0x94fdccebu, 0x5001e420u, 0x24126ea1u}));
}

TEST(StableId, EqualsFnv1a) {
  EXPECT_EQ(StableId(""), 0xcbf29ce484222325ull);
  EXPECT_EQ(StableId("foobar"), 0x85944171f73967e8ull);
}

TEST(Noise, DependsOnlyOnSeedStreamAndStep) {
  Noise first(1, StableId("robot/sonar"), 7);
  Noise again(1, StableId("robot/sonar"), 7);
  Noise other_step(1, StableId("robot/sonar"), 8);
  const double value = first.Uniform();
  EXPECT_EQ(value, again.Uniform());
  EXPECT_NE(value, other_step.Uniform());
  EXPECT_NE(value, first.Uniform());
}

TEST(Noise, GaussianHasMeanZeroAndVarianceOne) {
  constexpr int kDraws = 100000;
  Noise noise(42, 1, 1);
  double sum = 0, sum_of_squares = 0;
  for (int i = 0; i < kDraws; ++i) {
    const double x = noise.Gaussian();
    sum += x;
    sum_of_squares += x * x;
  }
  // The bounds are five standard errors of the mean and of the variance.
  EXPECT_NEAR(sum / kDraws, 0.0, 5.0 / std::sqrt(kDraws));
  EXPECT_NEAR(sum_of_squares / kDraws, 1.0, 5.0 * std::sqrt(2.0 / kDraws));
}

}  // namespace
}  // namespace gsv::base
