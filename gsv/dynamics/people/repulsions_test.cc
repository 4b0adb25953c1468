#include "gsv/dynamics/people/repulsions.h"

#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "gsv/dynamics/people/social_force.h"

namespace gsv::dynamics {
namespace {

using geometry::Vector2;

TEST(Repulsions, EqualTheSumOfSinglePairsInOrder) {
  constexpr std::uint32_t kWalkers = 7;
  std::vector<Vector2> forces(kWalkers), expected(kWalkers);
  Repulsions repulsions;
  // The test uses more pairs than are computed at a time. Among them are pairs at the same place
  // and pairs side by side.
  for (int i = 0; i < 1000; ++i) {
    const double angle = 0.37 * i, distance = i % 50 == 0 ? 0 : 0.003 * i;
    const Vector2 between{distance * std::cos(angle), distance * std::sin(angle)};
    const Vector2 velocity{0.0013 * i * std::cos(1.7 * i), i % 3 == 0 ? 0 : std::sin(2.9 * i)};
    const Vector2 wanted = i % 11 == 0 ? Vector2{} : Vector2{std::cos(0.9 * i), std::sin(0.9 * i)};
    const double radius = 0.25, other_radius = 0.001 * i;
    const auto walker = static_cast<std::uint32_t>(i) % kWalkers;
    repulsions.Add(walker, between, radius + other_radius, velocity, wanted, forces);
    expected[walker] =
        expected[walker] +
        AsSeen(RepulsionByOther(Apart(between, radius, other_radius), velocity), wanted);
  }
  repulsions.Finish(forces);
  for (std::uint32_t i = 0; i < kWalkers; ++i) {
    EXPECT_EQ(forces[i], expected[i]) << i;
    EXPECT_TRUE(std::isfinite(forces[i].x));
  }
}

}  // namespace
}  // namespace gsv::dynamics
