// Tests that a scan has the same result as its rays cast one by one, and as a brute-force search.
#include "gsv/sensing/rays/fan.h"

#include <set>

#include <gtest/gtest.h>

#include "gsv/geometry/constants.h"
#include "gsv/sensing/rays/ray_scene.h"
#include "gsv/sensing/rays/sectors.h"
#include "gsv/sensing/testing/test_rays.h"
#include "gsv/sensing/testing/test_snapshot.h"

namespace gsv::sensing {
namespace {

using geometry::Pose;
using geometry::Vector3;
using testing::Random;

using geometry::kInfinity;
using geometry::kPi;

std::vector<Vector3> DirectionsOf(double first, double step, int count, double elevation) {
  std::vector<Vector3> directions;
  for (int i = 0; i < count; ++i) {
    const double a = first + i * step;
    directions.push_back({std::cos(elevation) * std::cos(a), std::cos(elevation) * std::sin(a),
                          std::sin(elevation)});
  }
  return directions;
}

geometry::Shape AnyShape(Random& random) {
  const double a = random.Uniform(0.05, 1.5), b = random.Uniform(0.05, 1.5);
  switch (static_cast<int>(random.Uniform(0, 6))) {
    case 0:
      return geometry::Sphere{a};
    case 1:
      return geometry::Cylinder{a, b};
    case 2:
      return geometry::Capsule{a, b};
    case 3:
      return geometry::Ellipsoid{{a, b, 0.3}};
    case 4:
      return geometry::Cone{a, b};
    default:
      return geometry::Box{{a, 4 * b, 0.8}};
  }
}

// Returns shapes of all kinds at random places, static and moving, with a floor and a mesh.
std::shared_ptr<world::Snapshot> Clutter(Random& random, int count) {
  std::vector<testing::Placed> bodies;
  bodies.reserve(static_cast<std::size_t>(count) + 2);
  for (int i = 0; i < count; ++i) {
    bodies.push_back({"body" + std::to_string(i), testing::ModelOf(AnyShape(random)),
                      random.AnyPose(6), random.Uniform(0, 1) < 0.6});
  }
  bodies.push_back({"floor", testing::ModelOf(geometry::Plane{}), {{0, 0, -5}, {}}, true});
  bodies.push_back(
      {"mesh", testing::ModelOf(testing::RandomMesh(random, 20, 1)), random.AnyPose(3), true});
  return testing::MakeSnapshot(bodies);
}

struct Scanner {
  Pose world_from_fan;
  double first, step;
  int count;
  double elevation;
};

Scanner AnyScanner(Random& random, int round) {
  // The fan is level, as on most robots, or has any orientation. Its width is from a small sector
  // to more than a turn. It points up or down.
  const Pose place = round % 2 == 0 ? geometry::PlanarPose(random.Uniform(-4, 4),
                                                           random.Uniform(-4, 4), 0.1, round)
                                    : random.AnyPose(4);
  const double widths[] = {0.5, 2, 2 * kPi, 7 * kPi};
  const double width = widths[round % 4];
  const int count = round % 7 == 0 ? 1 : 90;
  return {place, random.Uniform(-2 * kPi, kPi), count > 1 ? width / (count - 1) : 0, count,
          round % 3 == 0 ? 0 : random.Uniform(-1.5, 1.5)};
}

TEST(Fan, EqualsSingleRays) {
  Random random(5);
  int hits = 0;
  for (int round = 0; round < 120; ++round) {
    const auto snapshot = Clutter(random, 40);
    RaySceneCache cache;
    const auto scene = cache.At(snapshot);
    const Scanner scanner = AnyScanner(random, round);
    const auto directions =
        DirectionsOf(scanner.first, scanner.step, scanner.count, scanner.elevation);
    const Fan fan{
        scanner.world_from_fan, scanner.first, scanner.step, scanner.elevation, 8, directions};
    const int ignored = round % 5;
    std::vector<double> ranges(directions.size());
    scene->Scan(fan, ignored, ranges);
    for (std::size_t i = 0; i < ranges.size(); ++i) {
      const Ray ray{fan.world_from_fan.position, fan.world_from_fan.orientation * directions[i], 8};
      ASSERT_EQ(ranges[i], scene->Range(ray, ignored)) << round << " " << i;
      const auto expected = testing::BruteForce(*snapshot, ray, ignored);
      ASSERT_NEAR(std::min(ranges[i], 9.0), expected ? expected->distance : 9.0, 1e-9);
      hits += expected.has_value();
    }
  }
  EXPECT_GT(hits, 2000);
}

// If the reach of a fan contains too many solids for its list, each ray is cast separately.
TEST(Fan, EqualsSingleRaysAmongManySolids) {
  Random random(6);
  const auto snapshot = Clutter(random, 700);
  RaySceneCache cache;
  const auto scene = cache.At(snapshot);
  const auto directions = DirectionsOf(0, 0.1, 63, 0);
  const Fan fan{{}, 0, 0.1, 0, 10, directions};
  std::vector<double> ranges(directions.size());
  scene->Scan(fan, -1, ranges);
  for (std::size_t i = 0; i < ranges.size(); ++i) {
    ASSERT_EQ(ranges[i], scene->Range({{}, directions[i], 10}, -1)) << i;
  }
}

TEST(Fan, WithNonFiniteRaysHitsNothing) {
  Random random(7);
  const auto snapshot = Clutter(random, 30);
  RaySceneCache cache;
  const auto scene = cache.At(snapshot);
  const auto directions = DirectionsOf(0, 0.1, 10, 0);
  std::vector<double> ranges(directions.size(), 1);
  scene->Scan({{{std::nan(""), 0, 0}, {}}, 0, 0.1, 0, 10, directions}, -1, ranges);
  EXPECT_EQ(ranges, std::vector<double>(10, kInfinity));
}

std::multiset<std::size_t> RaysIn(const Sector& sector, double first, double step, int count) {
  const auto directions = DirectionsOf(first, step, count, 0);
  std::multiset<std::size_t> rays;
  ForRunsIn(sector, {{}, first, step, 0, 10, directions}, [&](std::size_t from, std::size_t to) {
    for (std::size_t i = from; i <= to; ++i) rays.insert(i);
  });
  return rays;
}

TEST(Fan, SectorsContainEachRayOnce) {
  using Set = std::multiset<std::size_t>;
  const double degree = kPi / 180;
  EXPECT_EQ(RaysIn({0, 9.5 * degree, 12.5 * degree}, 0, degree, 360), (Set{10, 11, 12}));
  EXPECT_EQ(RaysIn({0, -1.5 * degree, 1.5 * degree}, 0, degree, 360), (Set{0, 1, 359}));
  EXPECT_EQ(RaysIn({0, 170.5 * degree, 181.5 * degree}, -180 * degree, degree, 360),
            (Set{0, 1, 351, 352, 353, 354, 355, 356, 357, 358, 359}));
  EXPECT_EQ(RaysIn({0, 359.5 * degree, 361.5 * degree}, 0, degree, 800),
            (Set{0, 1, 360, 361, 720, 721}));
  EXPECT_EQ(RaysIn({0, 2, 2.1}, 0, degree, 90), Set{});
  EXPECT_EQ(RaysIn({0, 2, 2.1, true}, 0, degree, 3), (Set{0, 1, 2}));
}

std::optional<Sector> SectorOf(const Fan& fan, const Pose& box_from_fan,
                               const geometry::Bounds& box) {
  BoxBatch boxes;
  boxes.Add(box_from_fan * Inverse(fan.world_from_fan), box);
  SectorBatch sectors;
  FindSectors(fan, boxes, sectors);
  return sectors.At(0);
}

// The sector of a box that faces the scanner is known in closed form.
TEST(Fan, SectorIsAsWideAsTheBox) {
  const auto directions = DirectionsOf(-1, 0.1, 21, 0);
  const Fan fan{{}, -1, 0.1, 0, 10, directions};
  const geometry::Bounds box{{2, -1, -0.5}, {3, 1, 0.5}};
  const auto sector = SectorOf(fan, {}, box);
  ASSERT_TRUE(sector);
  EXPECT_NEAR(sector->nearest, 2, 1e-5);
  EXPECT_NEAR(sector->from, -std::atan2(1, 2), 1e-5);
  EXPECT_NEAR(sector->to, std::atan2(1, 2), 1e-5);
  EXPECT_FALSE(SectorOf(fan, {{0, 0, 1}, {}}, box));    // the fan is above the box
  EXPECT_FALSE(SectorOf(fan, {{-20, 0, 0}, {}}, box));  // the box is too far away
  EXPECT_TRUE(SectorOf(fan, {{2.5, 0, 0}, {}}, box)->is_all);
}

}  // namespace
}  // namespace gsv::sensing
