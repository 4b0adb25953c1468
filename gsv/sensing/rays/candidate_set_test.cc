#include "gsv/sensing/rays/candidate_set.h"

#include <array>
#include <set>
#include <vector>

#include <gtest/gtest.h>

#include "gsv/sensing/testing/test_rays.h"

namespace gsv::sensing {
namespace {

using geometry::Vector3;
using testing::Random;

// The distance of a ray from a point.
double Gap(const Ray& ray, const Vector3& p) {
  const double along = std::clamp(Dot(p - ray.origin, ray.direction), 0.0, ray.max_distance);
  return Norm(p - (ray.origin + along * ray.direction));
}

TEST(CandidateSet, ContainsEverySphereThatARayTouchesAndFewOthers) {
  Random random(51);
  for (int round = 0; round < 300; ++round) {
    const Vector3 place = random.Point(5000);
    const Ray ray{place + random.Point(2), Normalized(random.Point(1)), 5};
    CandidateSet candidates;
    candidates.Begin(place, 10);
    std::vector<BoundingSphere> spheres;
    const auto count = static_cast<std::size_t>(random.Uniform(0, CandidateSet::kMax));
    for (std::uint32_t i = 0; i < count; ++i) {
      spheres.push_back({place + random.Point(9), random.Uniform(0.01, i % 9 == 0 ? 300 : 1)});
      if (i % 4 == 0) spheres[i].radius = Gap(ray, spheres[i].centre) + 1e-9;  // just touched
      candidates.Add(spheres[i], i, i % 3 != 0);
    }
    ASSERT_TRUE(candidates.Finish());
    ASSERT_TRUE(candidates.Covers(ray));
    std::set<std::uint32_t> found;
    candidates.Find(ray, ray.max_distance, [&](std::uint32_t i) { found.insert(i); });
    for (std::uint32_t i = 0; i < count; ++i) {
      const double gap = Gap(ray, spheres[i].centre) - spheres[i].radius;
      if (i % 3 == 0 || gap > 0.01) {
        EXPECT_FALSE(found.contains(i)) << round << " " << gap;
      } else if (gap <= 0) {
        EXPECT_TRUE(found.contains(i)) << round << " " << gap;
      }
    }
  }
}

TEST(CandidateSet, IsValidOnlyForRaysThatEndWithinIt) {
  CandidateSet candidates;
  candidates.Begin({1, 2, 3}, 5);
  EXPECT_TRUE(candidates.Covers({{1, 2, 4}, {1, 0, 0}, 4}));
  EXPECT_FALSE(candidates.Covers({{1, 2, 4}, {1, 0, 0}, 4.1}));
  EXPECT_FALSE(candidates.Covers({{1, 2, std::nan("")}, {1, 0, 0}, 1}));
}

TEST(CandidateSet, ReportsTooManyCandidates) {
  CandidateSet candidates;
  candidates.Begin({}, 5);
  for (std::uint32_t i = 0; i < CandidateSet::kMax; ++i) candidates.Add({{}, 1}, i, true);
  EXPECT_TRUE(candidates.Finish());
  candidates.Add({{}, 1}, 99, false);
  EXPECT_TRUE(candidates.Finish());
  candidates.Add({{}, 1}, 99, true);
  EXPECT_FALSE(candidates.Finish());
}

}  // namespace
}  // namespace gsv::sensing
