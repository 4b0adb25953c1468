#include "gsv/sensing/rays/ray_pairs.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <functional>

#include <gtest/gtest.h>

#include "gsv/geometry/constants.h"
#include "gsv/sensing/rays/packet_bounds.h"
#include "gsv/sensing/rays/ray_scene.h"
#include "gsv/sensing/testing/test_rays.h"

namespace gsv::sensing {
namespace {

using geometry::Box;
using geometry::Cylinder;
using geometry::Pose;
using geometry::Vector3;
using testing::Random;

// Random rays. Some of them are parallel to axes, or begin on a surface or inside a shape.
Ray AnyRay(int i, Random& random) {
  Vector3 direction = Normalized(random.Point(1));
  if (i % 5 == 0) direction = {i % 2 == 0 ? 1.0 : -1.0, 0, 0};
  if (i % 5 == 1) direction = {0, 0, i % 2 == 0 ? 1.0 : -1.0};
  Vector3 origin = random.Point(2);
  if (i % 7 == 0) origin = {0.5, -0.0, 0};
  return {origin, direction, 5};
}

Pose AnyPose(int i, Random& random) { return i % 3 == 0 ? Pose{} : random.AnyPose(1); }

// Expects that the distances are bit-identical to the distances of rays that are cast one by one.
template <class Shape, bool kHaveParts>
void ExpectDistancesOfSingleRays(const std::function<Shape()>& any_shape, Random& random) {
  if (!RayPairs::AreFast()) GTEST_SKIP() << "this processor has no AVX2";
  RayPairs pairs;
  int hits = 0;
  for (int round = 0; round < 1000; ++round) {
    RayPacket packet;
    while (packet.count < RayPacket::kMax)
      packet.Add(AnyRay(static_cast<int>(random.Uniform(0, 70)), random));
    std::array<double, RayPairs::kMax> expected;
    pairs.Clear();
    const std::size_t count = 1 + round % RayPairs::kMax;
    for (std::size_t k = 0; k < count; ++k) {
      const std::size_t ray = (k * 3 + round) % RayPacket::kMax;
      const Pose part_from_world = AnyPose(round + 1, random),
                 shape_from_set = AnyPose(static_cast<int>(k), random);
      const Shape shape = any_shape();
      pairs.Add(packet, ray, kHaveParts ? &part_from_world : nullptr, shape_from_set, shape);
      Ray moved = packet.At(ray);
      moved.max_distance = geometry::kInfinity;
      if (kHaveParts) moved = Moved(part_from_world, moved, moved.max_distance);
      moved = Moved(shape_from_set, moved, moved.max_distance);
      expected[k] = DistanceToShape(moved, shape).value_or(geometry::kInfinity);
      hits += expected[k] < geometry::kInfinity;
    }
    pairs.Cast<Shape, kHaveParts>();
    for (std::size_t k = 0; k < count; ++k) {
      EXPECT_EQ(pairs.ray(k), (k * 3 + round) % RayPacket::kMax);
      EXPECT_EQ(std::bit_cast<std::uint64_t>(pairs.distance(k)),
                std::bit_cast<std::uint64_t>(expected[k]))
          << "round " << round << ", pair " << k;
    }
  }
  EXPECT_GT(hits, 500);
}

TEST(RayPairs, DistancesToCylindersEqualThoseOfSingleRays) {
  Random random(61);
  const auto any = [&] { return Cylinder{random.Uniform(0.2, 2), random.Uniform(0.2, 3)}; };
  ExpectDistancesOfSingleRays<Cylinder, false>(any, random);
  ExpectDistancesOfSingleRays<Cylinder, true>(any, random);
}

TEST(RayPairs, DistancesToBoxesEqualThoseOfSingleRays) {
  Random random(62);
  const auto any = [&] {
    return Box{{random.Uniform(0.2, 3), random.Uniform(0.2, 3), random.Uniform(0.2, 3)}};
  };
  ExpectDistancesOfSingleRays<Box, false>(any, random);
  ExpectDistancesOfSingleRays<Box, true>(any, random);
}

// Whether the box with the opposite corners a and b touches `box`. Compares the intervals of both
// boxes along each axis.
bool Touch(const Vector3& a, const Vector3& b, const geometry::Bounds& box) {
  const auto meet = [](double from, double to, double low, double high) {
    return std::max(from, to) >= low && std::min(from, to) <= high;
  };
  return meet(a.x, b.x, box.min.x, box.max.x) && meet(a.y, b.y, box.min.y, box.max.y) &&
         meet(a.z, b.z, box.min.z, box.max.z);
}

TEST(PacketBounds, FindsTheRaysWhoseBoxesTouchABox) {
  Random random(3);
  int touching = 0;
  for (int round = 0; round < 2000; ++round) {
    RayPacket packet;
    while (packet.count < RayPacket::kMax) packet.Add(AnyRay(round, random));
    const Vector3 corner = random.Point(3), size = random.Point(1);
    const geometry::Bounds box{
        corner, corner + Vector3{std::abs(size.x), std::abs(size.y), std::abs(size.z)}};
    unsigned expected = 0;
    for (std::size_t i = 0; i < packet.count; ++i) {
      const Ray ray = packet.At(i);
      const Vector3 end = ray.origin + ray.max_distance * ray.direction;
      expected |= static_cast<unsigned>(Touch(ray.origin, end, box)) << i;
    }
    EXPECT_EQ(PacketBounds(packet).Touching(box), expected) << "round " << round;
    touching += std::popcount(expected);
  }
  EXPECT_GT(touching, 500);
}

TEST(PacketBounds, BoxesThatShareAFaceTouch) {
  RayPacket packet;
  for (std::size_t i = 0; i < RayPacket::kMax; ++i) {
    packet.Add({{}, {1, 0, 0}, 1.0 + static_cast<double>(i)});
  }
  EXPECT_EQ(PacketBounds(packet).Touching({{3, -1, -1}, {4, 1, 1}}), 0b1111'1100u);
  EXPECT_EQ(PacketBounds(packet).Touching({{-2, 0, 0}, {0, 1, 1}}), 0b1111'1111u);
  EXPECT_EQ(PacketBounds(packet).Touching({{-2, 0, 0}, {-1, 1, 1}}), 0u);
}

}  // namespace
}  // namespace gsv::sensing
