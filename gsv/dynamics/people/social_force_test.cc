#include "gsv/dynamics/people/social_force.h"

#include <cmath>

#include <gtest/gtest.h>

namespace gsv::dynamics {
namespace {

using geometry::Vector2;

double LengthOf(Vector2 v) { return std::hypot(v.x, v.y); }

// The potential of Helbing and Molnár, as in the paper.
double PotentialAt(Vector2 apart, Vector2 velocity) {
  const Vector2 stride = 2.0 * velocity;
  const double sum = LengthOf(apart) + LengthOf(apart - stride);
  const double b = std::sqrt(sum * sum - LengthOf(stride) * LengthOf(stride)) / 2;
  return 2.1 * std::exp(-b / 0.3);
}

TEST(SocialForce, IsTheRotatedGradientOfThePotential) {
  constexpr double kStep = 1e-6;
  for (const Vector2 apart : {Vector2{0.8, 0.3}, Vector2{-1.2, 0.9}, Vector2{0.1, -0.6}}) {
    for (const Vector2 velocity : {Vector2{0, 0}, Vector2{-1.2, 0.1}, Vector2{0.3, 1.1}}) {
      const Vector2 gradient{(PotentialAt(apart + Vector2{kStep, 0}, velocity) -
                              PotentialAt(apart - Vector2{kStep, 0}, velocity)) /
                                 (2 * kStep),
                             (PotentialAt(apart + Vector2{0, kStep}, velocity) -
                              PotentialAt(apart - Vector2{0, kStep}, velocity)) /
                                 (2 * kStep)};
      const Vector2 force = RepulsionByOther(apart, velocity);
      const double c = std::cos(kAside), s = std::sin(kAside);
      EXPECT_NEAR(force.x, -(c * gradient.x - s * gradient.y), 1e-6);
      EXPECT_NEAR(force.y, -(s * gradient.x + c * gradient.y), 1e-6);
    }
  }
}

TEST(SocialForce, OfAStandingPedestrianDecaysWithTheDistance) {
  // If the other pedestrian does not move, b equals the distance.
  EXPECT_NEAR(LengthOf(RepulsionByOther({0.9, 0}, {})), 7 * std::exp(-3.0), 1e-12);
}

TEST(SocialForce, OfAWallDecaysWithTheDistance) {
  const Vector2 force = RepulsionByWall({0, 1}, 0.4);
  EXPECT_EQ(force.x, 0);
  EXPECT_NEAR(force.y, 50 * std::exp(-2.0), 1e-12);
  EXPECT_NEAR(RepulsionByWall({0, 1}, -0.1).y, 50, 1e-12);
}

TEST(SocialForce, OfAPedestrianBehindIsHalved) {
  const Vector2 from_ahead{-1, 0}, from_behind{1, 0};
  EXPECT_EQ(AsSeen(from_ahead, {1, 0}), from_ahead);
  EXPECT_EQ(AsSeen(from_behind, {1, 0}), (Vector2{0.5, 0}));
  // The limit is 100 degrees from the direction of motion. One pedestrian is at 99 degrees, and one
  // at 101 degrees.
  const auto from = [](double degrees) {
    const double a = degrees * 3.14159265358979323846 / 180;
    return Vector2{-std::cos(a), -std::sin(a)};
  };
  EXPECT_NEAR(LengthOf(AsSeen(from(99), {1, 0})), 1, 1e-12);
  EXPECT_NEAR(LengthOf(AsSeen(from(101), {1, 0})), 0.5, 1e-12);
}

TEST(SocialForce, UsesTheDistanceToTheSurface) {
  EXPECT_EQ(Apart({2, 0}, 0.1, 0.1), (Vector2{2, 0}));
  EXPECT_NEAR(Apart({2, 0}, 0.25, 0.25).x, 1.7, 1e-12);
  EXPECT_NEAR(Apart({2, 0}, 0.25, 1.25).x, 0.7, 1e-12);
  EXPECT_NEAR(Apart({0, 0.5}, 0.25, 1.25).y, 0.05, 1e-12);
}

TEST(SocialForce, AcceleratesExponentiallyToTheDesiredVelocity) {
  Vector2 velocity;
  for (int i = 1; i <= 40; ++i) {
    velocity = NextVelocity(velocity, {1.34, 0}, {}, 1.34, 0.05, Relaxation(0.05));
    EXPECT_NEAR(velocity.x, 1.34 * (1 - std::exp(-0.05 * i / 0.5)), 1e-12);
  }
  EXPECT_NEAR(LengthOf(NextVelocity({0, 0}, {1, 0}, {1000, 0}, 1, 0.05, Relaxation(0.05))), 1.3,
              1e-12);
}

}  // namespace
}  // namespace gsv::dynamics
