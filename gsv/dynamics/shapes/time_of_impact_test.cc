#include "gsv/dynamics/shapes/time_of_impact.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "gsv/base/random.h"

namespace gsv::dynamics {
namespace {

ConvexPiece Rectangle(double half_length, double half_width) {
  return Hull({{-half_length, -half_width},
               {half_length, -half_width},
               {half_length, half_width},
               {-half_length, half_width}});
}

TEST(Advance, FollowsACircle) {
  for (const double w : {1e-12, 1e-6, 0.3, -2.0, 40.0}) {
    const geometry::PlanarPosition end = geometry::Advance({1, 2, 0, 1}, {0.7, 0, w}, 1.5);
    // The piece first moves along y; the centre of its circle is v / w to the left.
    const double r = 0.7 / w, angle = w * 1.5;
    const double x = std::abs(w) < 1e-5 ? 1 - 0.7 * 1.5 * angle / 2 : 1 - r * (1 - std::cos(angle));
    EXPECT_NEAR(end.x, x, 1e-9) << w;
    EXPECT_NEAR(end.y, 2 + (std::abs(w) < 1e-5 ? 0.7 * 1.5 : r * std::sin(angle)), 1e-9) << w;
    EXPECT_NEAR(end.cosine, -std::sin(angle), 1e-12) << w;
    EXPECT_NEAR(end.sine, std::cos(angle), 1e-12) << w;
  }
}

TEST(Advance, CanMoveSideways) {
  const geometry::PlanarPosition end = geometry::Advance({}, {0, 2, std::numbers::pi}, 1);
  // The path is half a circle of radius 2 / pi to the left. It ends at x = -2 r.
  EXPECT_NEAR(end.x, -4 / std::numbers::pi, 1e-12);
  EXPECT_NEAR(end.y, 0, 1e-12);
}

ConvexPiece AtStart(const MovingPiece& moving) {
  ConvexPiece placed;
  Place(*moving.piece, moving.start, placed);
  return placed;
}

std::optional<Impact> Find(const MovingPiece& a, const MovingPiece& b, double end) {
  return FindImpact(a, b, end, Separate(AtStart(a), AtStart(b)).normal);
}

std::optional<Impact> Find(const MovingPiece& a, const ConvexPiece& standing, double end) {
  return FindImpact(a, standing, end, Separate(AtStart(a), standing).normal);
}

TEST(FindImpact, OfADiscAndAWallIsTheTimeAtWhichTheGapCloses) {
  const ConvexPiece disc = Disc({}, 0.5), wall = Hull({{3, -5}, {3, 5}});
  const auto impact = Find({&disc, {}, {2, 0, 0}}, wall, 10);
  ASSERT_TRUE(impact);
  EXPECT_NEAR(impact->time, (2.5 - kStopGap) / 2, 1e-9);
  EXPECT_NEAR(impact->normal.x, 1, 1e-12);
  EXPECT_TRUE(impact->first_approaches);
  EXPECT_FALSE(impact->second_approaches);
  EXPECT_FALSE(Find({&disc, {}, {2, 0, 0}}, wall, 1.24));
  EXPECT_FALSE(Find({&disc, {}, {-2, 0, 0}}, wall, 10));
}

TEST(FindImpact, IsEmptyForSlidingAlongAWall) {
  const ConvexPiece disc = Disc({}, 0.5), wall = Hull({{-100, 0.5 + 0.6e-6}, {100, 0.5 + 0.6e-6}});
  EXPECT_FALSE(Find({&disc, {}, {5, 0, 0}}, wall, 10));
  EXPECT_FALSE(Find({&disc, {}, {5, 0, -1}}, wall, 1));  // turning away
  const auto into = Find({&disc, {}, {5, 0, 1}}, wall, 1);
  ASSERT_TRUE(into);
  EXPECT_LT(into->time, 1e-3);
}

TEST(FindImpact, ReturnsWhichMotionClosesTheGap) {
  const ConvexPiece disc = Disc({}, 0.5);
  const MovingPiece slow{&disc, {2, 0, 1, 0}, {0.5, 0, 0}};
  const auto behind = Find({&disc, {}, {1.5, 0, 0}}, slow, 10);
  ASSERT_TRUE(behind);
  EXPECT_NEAR(behind->time, 1, 1e-5);
  EXPECT_TRUE(behind->first_approaches);
  EXPECT_FALSE(behind->second_approaches);
  const auto head_on = Find({&disc, {}, {1.5, 0, 0}}, {&disc, {2, 0, -1, 0}, {0.5, 0, 0}}, 10);
  ASSERT_TRUE(head_on);
  EXPECT_NEAR(head_on->time, 0.5, 1e-5);
  EXPECT_TRUE(head_on->first_approaches);
  EXPECT_TRUE(head_on->second_approaches);
}

double GapAt(const MovingPiece& a, const MovingPiece& b, double time) {
  ConvexPiece placed_a, placed_b;
  const geometry::PlanarPosition at_a = geometry::Advance(a.start, a.twist, time),
                                 at_b = geometry::Advance(b.start, b.twist, time);
  Place(*a.piece, at_a, placed_a);
  Place(*b.piece, at_b, placed_b);
  return Separate(placed_a, placed_b).distance;
}

TEST(FindImpact, EqualsADenseSampling) {
  base::Noise noise(5, 6, 7);
  const auto uniform = [&](double low, double high) {
    return low + (high - low) * noise.Uniform();
  };
  const std::vector<ConvexPiece> pieces = {Disc({0.1, 0}, 0.3), Rectangle(0.5, 0.02),
                                           Rectangle(0.3, 0.3), Hull({{0, 0}, {1, 0}, {0.2, 0.4}})};
  int impacts = 0;
  for (int i = 0; i < 600; ++i) {
    const auto moving = [&](double x) {
      const double heading = uniform(-3, 3);
      return MovingPiece{&pieces[static_cast<std::size_t>(uniform(0, 4))],
                         {x, uniform(-0.5, 0.5), std::cos(heading), std::sin(heading)},
                         {uniform(-3, 3), uniform(-3, 3), uniform(-6, 6)}};
    };
    const MovingPiece a = moving(-0.9), b = moving(0.9);
    if (GapAt(a, b, 0) <= kTouchGap) continue;
    const auto impact = Find(a, b, 1);
    const double until = impact ? impact->time : 1;
    for (int k = 0; k <= 1000; ++k) {
      ASSERT_GT(GapAt(a, b, until * k / 1000), 0) << i << " at " << until * k / 1000;
    }
    if (!impact) continue;
    ++impacts;
    EXPECT_LE(GapAt(a, b, until), kTouchGap) << i;
    EXPECT_GE(GapAt(a, b, until), 0.2e-6) << i;
  }
  EXPECT_GT(impacts, 60);
}

}  // namespace
}  // namespace gsv::dynamics
