// Tests that rays in a row have exactly the distances of single rays, also at the borders of shapes.
#include "gsv/sensing/rays/ray_row.h"

#include <gtest/gtest.h>

#include "gsv/geometry/constants.h"
#include "gsv/sensing/testing/test_rays.h"

namespace gsv::sensing {
namespace {

using geometry::Pose;
using geometry::Vector3;
using testing::Random;

// Axes, diagonals and random directions, some of them zero in one coordinate.
std::vector<Vector3> Directions(Random& random) {
  std::vector<Vector3> all{{1, 0, 0}, {-1, 0, 0},   {0, 1, 0},     {0, -1, 0},
                           {0, 0, 1}, {0, -0., -1}, {0.6, 0.8, 0}, {0.6, -0.8, -0.}};
  for (int i = 0; i < 29; ++i) {
    const double angle = random.Uniform(-3, 3), slope = i % 3 == 0 ? 0 : random.Uniform(-1, 1);
    all.push_back(
        {std::cos(slope) * std::cos(angle), std::cos(slope) * std::sin(angle), std::sin(slope)});
  }
  return all;
}

void ExpectEqual(const geometry::Shape& shape, const Vector3& origin, double max_distance,
                 Random& random) {
  const std::vector<Vector3> directions = Directions(random);
  RayRow row({Pose{origin, {}}, 0, 0, 0, max_distance, directions});
  CastAtShape(shape, {row.origin, {}}, 0, 0, directions.size() - 1, row);
  for (std::size_t i = 0; i < directions.size(); ++i) {
    const auto alone = DistanceToShape({origin, directions[i], max_distance}, shape);
    EXPECT_EQ(row.ranges[i], alone.value_or(geometry::kInfinity))
        << "ray " << i << " from " << origin.x << ' ' << origin.y << ' ' << origin.z;
  }
}

TEST(RayRow, EqualsSingleRaysFromInsideFromOutsideAndOnASurface) {
  Random random(11);
  const geometry::Box box{{1, 2, 0.5}};
  const geometry::Cylinder cylinder{0.5, 1};
  const std::vector<Vector3> places{{0, 0, 0},   {0.5, 0, 0},   {-0.5, 1, 0.25}, {0, -1, 0},
                                    {0, 0, 0.5}, {0.3, 0.4, 0}, {0.5, 0, 0.5},   {-3, 0, 0},
                                    {0.1, 0, 4}, {-2, 1, 0.25}, {0.25, -5, 0.1}};
  for (const Vector3& place : places) {
    for (const double max_distance : {0.0, 0.4, 10.0}) {
      ExpectEqual(box, place, max_distance, random);
      ExpectEqual(cylinder, place, max_distance, random);
      ExpectEqual(geometry::Sphere{0.5}, place, max_distance, random);
    }
  }
}

TEST(RayRow, EqualsSingleRaysFromRandomPlaces) {
  Random random(12);
  for (int i = 0; i < 300; ++i) {
    const Vector3 place{random.Uniform(-2, 2), random.Uniform(-2, 2), random.Uniform(-1, 1)};
    const double a = random.Uniform(0.01, 2), b = random.Uniform(0.01, 2);
    ExpectEqual(geometry::Box{{a, b, 1}}, place, 5, random);
    ExpectEqual(geometry::Cylinder{a, b}, place, 5, random);
  }
}

TEST(RayRow, KeepsTheNearestOfSeveralShapes) {
  const std::vector<Vector3> directions(5, {1, 0, 0});
  RayRow row({Pose{}, 0, 0, 0, 10, directions});
  const geometry::Box box{{1, 1, 1}};
  CastAtShape(box, {{-4, 0, 0}, {}}, 3.5, 0, 4, row);
  CastAtShape(box, {{-7, 0, 0}, {}}, 6.5, 0, 4, row);
  CastAtShape(box, {{-2, 0, 0}, {}}, 1.5, 0, 2, row);
  EXPECT_EQ(row.ranges[2], 1.5);
  EXPECT_EQ(row.ranges[4], 3.5);
}

}  // namespace
}  // namespace gsv::sensing
