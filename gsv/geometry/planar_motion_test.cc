#include "gsv/geometry/planar_motion.h"

#include <random>

#include <gtest/gtest.h>

#include "gsv/geometry/constants.h"

namespace gsv::geometry {
namespace {

TEST(SineCosine, AgreesWithTheLibraryToTheLastBits) {
  std::mt19937_64 random(1);
  for (const double largest : {1e-12, 1e-3, 0.125, 0.126, 10.0}) {
    std::uniform_real_distribution<double> angles(-largest, largest);
    for (int i = 0; i < 10'000; ++i) {
      const double angle = angles(random);
      const SineCosine is(angle);
      // The tolerance is two units in the last place.
      ASSERT_NEAR(is.sine, std::sin(angle), std::abs(std::sin(angle)) * 0x1p-51) << angle;
      ASSERT_NEAR(is.cosine, std::cos(angle), 0x1p-52) << angle;
    }
  }
  EXPECT_EQ(SineCosine(0).sine, 0);
  EXPECT_EQ(SineCosine(0).cosine, 1);
}

TEST(PlanarMotion, QuarterCircleEndsAtItsClosedForm) {
  for (const int pieces : {1, 3, 10, 10'000}) {
    PlanarPosition at;
    for (int i = 0; i < pieces; ++i) at = Advance(at, {kPi / 2, 0, kPi / 2}, 1.0 / pieces);
    EXPECT_NEAR(at.x, 1, 1e-12) << pieces;
    EXPECT_NEAR(at.y, 1, 1e-12) << pieces;
    EXPECT_NEAR(at.cosine, 0, 1e-12) << pieces;
    EXPECT_NEAR(at.sine, 1, 1e-12) << pieces;
  }
}

TEST(PlanarMotion, SmallTurnIsNearlyStraight) {
  const PlanarPosition at = Advance({}, {1, 0, 1e-9}, 1);
  EXPECT_NEAR(at.x, 1, 1e-15);
  EXPECT_NEAR(at.y, 5e-10, 1e-18);
}

TEST(PlanarPosition, NormalizeRemovesRoundingErrors) {
  PlanarPosition at{0, 0, 0.6 * (1 + 1e-9), 0.8 * (1 + 1e-9)};
  at.Normalize();
  EXPECT_NEAR(at.cosine, 0.6, 1e-15);
  EXPECT_NEAR(at.sine, 0.8, 1e-15);
}

}  // namespace
}  // namespace gsv::geometry
