// Tests that rays in a row have exactly the distances of single rays, also at the borders of shapes.
#include "gsv/sensing/rays/ray_row.h"

#include <gtest/gtest.h>

#include "gsv/geometry/constants.h"
#include "gsv/sensing/rays/ray_shape.h"
#include "gsv/sensing/testing/test_rays.h"

namespace gsv::sensing {
namespace {

using geometry::Pose;
using geometry::Quaternion;
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
                 std::span<const Quaternion> rotations, Random& random) {
  const std::vector<Vector3> directions = Directions(random);
  RayRow row({Pose{}, 0, 0, 0, max_distance, directions});
  row.CastAt(shape, {origin, rotations}, 0, 0, directions.size() - 1);
  for (std::size_t i = 0; i < directions.size(); ++i) {
    Vector3 direction = directions[i];
    for (const Quaternion& rotation : rotations) direction = rotation * direction;
    const auto alone = DistanceToShape({origin, direction, max_distance}, shape);
    EXPECT_EQ(row.range(i), alone.value_or(geometry::kInfinity))
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
  const std::array rotations{Quaternion{}};
  for (const Vector3& place : places) {
    for (const double max_distance : {0.0, 0.4, 10.0}) {
      ExpectEqual(box, place, max_distance, rotations, random);
      ExpectEqual(cylinder, place, max_distance, rotations, random);
      ExpectEqual(geometry::Sphere{0.5}, place, max_distance, rotations, random);
    }
  }
}

TEST(RayRow, EqualsSingleRaysFromRandomPlaces) {
  Random random(12);
  for (int i = 0; i < 300; ++i) {
    const Pose a = random.AnyPose(2);
    const std::array rotations{a.orientation, random.AnyPose(1).orientation};
    const auto used = std::span(rotations).first(1 + i % 2);
    const double width = random.Uniform(0.01, 2), length = random.Uniform(0.01, 2);
    ExpectEqual(geometry::Box{{width, length, 1}}, a.position, 5, used, random);
    ExpectEqual(geometry::Cylinder{width, length}, a.position, 5, used, random);
    ExpectEqual(geometry::Cone{width, length}, a.position, 5, used, random);
  }
}

TEST(RayRow, KeepsTheNearestOfSeveralShapes) {
  const std::vector<Vector3> directions(5, {1, 0, 0});
  RayRow row({Pose{}, 0, 0, 0, 10, directions});
  const geometry::Box box{{1, 1, 1}};
  const std::array rotations{Quaternion{}};
  row.CastAt(box, {{-4, 0, 0}, rotations}, 3.5, 0, 4);
  row.CastAt(box, {{-7, 0, 0}, rotations}, 6.5, 0, 4);
  EXPECT_EQ(row.range(2), 3.5);
  row.CastAt(box, {{-2, 0, 0}, rotations}, 1.5, 0, 2);
  EXPECT_EQ(row.range(0), 1.5);
  EXPECT_EQ(row.range(4), 3.5);
  EXPECT_EQ(row.At(4).max_distance, 3.5);
}

}  // namespace
}  // namespace gsv::sensing
