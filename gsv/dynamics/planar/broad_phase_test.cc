// Compares the results of the grids with a comparison of all pairs.

#include <algorithm>

#include <gtest/gtest.h>

#include "gsv/base/random.h"
#include "gsv/dynamics/planar/broad_phase.h"
#include "gsv/dynamics/shapes/obstacle_field.h"

namespace gsv::dynamics {
namespace {

TEST(BroadPhase, EqualsABruteForceComparison) {
  base::Noise noise(1, 1, 1);
  BroadPhase finder;
  for (int round = 0; round < 30; ++round) {
    const double extent = round % 3 == 0 ? 2 : round % 3 == 1 ? 30 : 5000;
    std::vector<Vector2> centres;
    std::vector<double> radii;
    for (int i = 0; i < 10 * round; ++i) {
      centres.push_back({extent * noise.Uniform() - 7, extent * noise.Uniform() + 100});
      radii.push_back(0.1 + noise.Uniform() * (i % 10 == 0 ? 2 : 0.3));
    }
    std::vector<BroadPhase::Pair> expected;
    for (std::uint32_t i = 0; i < centres.size(); ++i) {
      for (std::uint32_t k = i + 1; k < centres.size(); ++k) {
        const Vector2 d = centres[i] - centres[k];
        if (Dot(d, d) <= (radii[i] + radii[k]) * (radii[i] + radii[k])) expected.push_back({i, k});
      }
    }
    EXPECT_EQ(finder.Find(centres, radii), expected) << round;
  }
}

TEST(ObstacleField, FindsAllNearObstacles) {
  base::Noise noise(2, 2, 2);
  const auto uniform = [&](double low, double high) {
    return low + (high - low) * noise.Uniform();
  };
  std::vector<Obstacle> obstacles;
  for (int i = 0; i < 300; ++i) {
    const Vector2 from{uniform(-20, 20), uniform(-20, 20)};
    // The first obstacle is too large for the grid.
    const double length = i == 0 ? 5000 : i % 50 == 0 ? 30 : 2;
    const ConvexPiece piece =
        Hull({from, from + Vector2{uniform(-length, length), uniform(-length, length)}});
    const ConvexPiece disc = BoundingDisc(piece);
    obstacles.push_back({piece, disc.vertices[0], disc.radius, i});
  }
  const ObstacleField field(obstacles, 0.3);
  std::size_t total = 0;
  for (int i = 0; i < 2000; ++i) {
    const Vector2 point{uniform(-30, 30), uniform(-30, 30)};
    const double reach =
        i % 2 ? uniform(0, 0.3) : uniform(0.3, 8);  // distances within the margin, and beyond it
    std::vector<bool> found(obstacles.size());
    field.ForEachNear(point, reach, [&](std::uint32_t index) { found[index] = true; });
    for (std::size_t k = 0; k < obstacles.size(); ++k) {
      if (DistanceTo(obstacles[k].shape, point) > reach) continue;
      EXPECT_TRUE(found[k]) << i << " " << k;
      ++total;
    }
  }
  EXPECT_GT(total, 1000u);
}

TEST(ObstacleField, FindsNothingWithoutObstacles) {
  const ObstacleField field({}, 0.3);
  field.ForEachNear({0, 0}, 10, [](std::uint32_t) { FAIL(); });
}

}  // namespace
}  // namespace gsv::dynamics
