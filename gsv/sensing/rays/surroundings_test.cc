#include "gsv/sensing/rays/surroundings.h"

#include <set>

#include <gtest/gtest.h>

#include "gsv/sensing/testing/test_rays.h"

namespace gsv::sensing {
namespace {

using geometry::Vector3;
using testing::Random;

// How near a ray comes to a point.
double Gap(const Ray& ray, const Vector3& p) {
  const double along = std::clamp(Dot(p - ray.origin, ray.direction), 0.0, ray.max_distance);
  return Norm(p - (ray.origin + along * ray.direction));
}

TEST(Surroundings, FindEveryBallThatARayTouchesAndFewOthers) {
  Random random(51);
  for (int round = 0; round < 300; ++round) {
    const Vector3 place = random.Point(5000);
    const Ray ray{place + random.Point(2), Normalized(random.Point(1)), 5};
    Surroundings surroundings;
    surroundings.Begin(place, 10);
    std::vector<Ball> balls;
    const auto count = static_cast<std::size_t>(random.Uniform(0, Surroundings::kMost));
    for (std::uint32_t i = 0; i < count; ++i) {
      balls.push_back({place + random.Point(9), random.Uniform(0.01, i % 9 == 0 ? 300 : 1)});
      if (i % 4 == 0) balls[i].radius = Gap(ray, balls[i].centre) + 1e-9;  // hardly touched
      surroundings.Add(balls[i], i, i % 3 != 0);
    }
    ASSERT_TRUE(surroundings.Finish());
    ASSERT_TRUE(surroundings.Hold(ray));
    std::set<std::uint32_t> found;
    surroundings.Find(ray, ray.max_distance, [&](std::uint32_t i) { found.insert(i); });
    for (std::uint32_t i = 0; i < count; ++i) {
      const double gap = Gap(ray, balls[i].centre) - balls[i].radius;
      if (i % 3 == 0 || gap > 0.01) {
        EXPECT_FALSE(found.contains(i)) << round << " " << gap;
      } else if (gap <= 0) {
        EXPECT_TRUE(found.contains(i)) << round << " " << gap;
      }
    }
  }
}

TEST(Surroundings, HoldOnlyRaysThatEndWithin) {
  Surroundings surroundings;
  surroundings.Begin({1, 2, 3}, 5);
  EXPECT_TRUE(surroundings.Hold({{1, 2, 4}, {1, 0, 0}, 4}));
  EXPECT_FALSE(surroundings.Hold({{1, 2, 4}, {1, 0, 0}, 4.1}));
  EXPECT_FALSE(surroundings.Hold({{1, 2, std::nan("")}, {1, 0, 0}, 1}));
}

TEST(Surroundings, SayWhenTheyAreTooMany) {
  Surroundings surroundings;
  surroundings.Begin({}, 5);
  for (std::uint32_t i = 0; i < Surroundings::kMost; ++i) surroundings.Add({{}, 1}, i, true);
  EXPECT_TRUE(surroundings.Finish());
  surroundings.Add({{}, 1}, 99, false);
  EXPECT_TRUE(surroundings.Finish());
  surroundings.Add({{}, 1}, 99, true);
  EXPECT_FALSE(surroundings.Finish());
}

}  // namespace
}  // namespace gsv::sensing
