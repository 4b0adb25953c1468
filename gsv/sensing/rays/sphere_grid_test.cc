#include "gsv/sensing/rays/sphere_grid.h"

#include <cmath>
#include <limits>
#include <map>

#include <gtest/gtest.h>

#include "gsv/sensing/testing/test_rays.h"

namespace gsv::sensing {
namespace {

using geometry::Bounds;
using geometry::Vector3;
using testing::Random;

struct Solids {
  std::vector<BoundingSphere> spheres;
  std::vector<Bounds> boxes;

  void Add(const BoundingSphere& sphere) {
    const Vector3 r{sphere.radius, sphere.radius, sphere.radius};
    spheres.push_back(sphere);
    boxes.push_back({sphere.centre - r, sphere.centre + r});
  }
};

// The distance of a ray from a sphere; negative if it touches the sphere.
double Gap(const Ray& ray, const BoundingSphere& sphere) {
  const Vector3 way = sphere.centre - ray.origin;
  const double along = std::clamp(Dot(way, ray.direction), 0.0, ray.max_distance);
  return Norm(way - along * ray.direction) - sphere.radius;
}

RayPacket PacketFrom(const Vector3& place, std::size_t count, Random& random) {
  RayPacket packet;
  while (packet.count < count) {
    packet.Add({place + random.Point(0.3), Normalized(random.Point(1)), random.Uniform(0, 5)});
  }
  return packet;
}

// Expects for each ray that all spheres that the ray hits are found. Other spheres may be found
// only if the ray misses them by at most `margin`, or if they are large.
void ExpectTouched(const Solids& solids, const RayPacket& packet, const TouchedSpheres& found,
                   double margin) {
  std::map<std::uint32_t, unsigned> rays_of;
  for (const auto& [number, rays] : found.all()) {
    EXPECT_NE(rays, 0u);
    EXPECT_EQ(rays >> packet.count, 0u);
    EXPECT_TRUE(rays_of.emplace(number, rays).second) << "sphere " << number << " found twice";
  }
  for (std::uint32_t i = 0; i < solids.spheres.size(); ++i) {
    for (std::size_t ray = 0; ray < packet.count; ++ray) {
      const double gap = Gap(packet.At(ray), solids.spheres[i]);
      const bool is_found = rays_of.contains(i) && (rays_of[i] >> ray & 1) != 0;
      if (gap <= 0) {
        EXPECT_TRUE(is_found) << gap;
      } else if (gap > margin && solids.spheres[i].radius < 3) {
        EXPECT_FALSE(is_found) << gap;
      }
    }
  }
}

TEST(SphereGrid, FindsAllSpheresThatAPacketTouchesAndFewOthers) {
  Random random(53);
  for (int round = 0; round < 300; ++round) {
    const double far_away = round % 3 == 0 ? 90'000 : 300;
    const Vector3 place = random.Point(far_away);
    const RayPacket packet = PacketFrom(place, 1 + round % RayPacket::kMax, random);
    Solids solids;
    const int count = round % 5 == 0 ? 5 : 200;
    for (int i = 0; i < count; ++i) {
      BoundingSphere sphere{place + random.Point(25), random.Uniform(0.01, 0.9)};
      if (i % 40 == 0) sphere.radius = random.Uniform(8, 200);
      const Ray ray = packet.At(0);
      if (i % 40 == 1) sphere.centre = ray.origin + ray.max_distance * ray.direction;
      if (i % 40 == 2) sphere.radius += Gap(ray, sphere) + 1e-9;  // just touched
      if (sphere.radius > 0) solids.Add(sphere);
    }
    SphereGrid grid;
    grid.Build(solids.spheres, solids.boxes);
    TouchedSpheres found;
    ASSERT_TRUE(grid.FindTouched({packet, place, 6}, found)) << round;
    ExpectTouched(solids, packet, found, far_away > 1000 ? 2 : 0.01);
  }
}

TEST(SphereGrid, FindsNothingWithoutSpheres) {
  Random random(54);
  SphereGrid grid;
  grid.Build({}, {});
  TouchedSpheres found;
  EXPECT_TRUE(grid.FindTouched({PacketFrom({}, 8, random), {}, 6}, found));
  EXPECT_EQ(found.count, 0u);
}

TEST(SphereGrid, AppendsToWhatAnotherGridHasFound) {
  const BoundingSphere sphere{{2, 0, 0}, 0.5};
  Solids solids;
  solids.Add(sphere);
  SphereGrid grid;
  grid.Build(solids.spheres, solids.boxes);
  RayPacket packet;
  packet.Add({{}, {1, 0, 0}, 5});
  TouchedSpheres found;
  ASSERT_TRUE(grid.FindTouched({packet, {}, 5}, found));
  ASSERT_TRUE(grid.FindTouched({packet, {}, 5}, found));
  EXPECT_EQ(found.count, 2u);
}

TEST(SphereGrid, RefusesCrowdedPlacesAndCoordinatesThatAreNotFinite) {
  RayPacket packet;
  packet.Add({{}, {1, 0, 0}, 5});
  Solids solids;
  for (std::size_t i = 0; i <= TouchedSpheres::kMax; ++i) {
    solids.Add({{2 + 1e-3 * static_cast<double>(i), 0, 0}, 0.5});
  }
  SphereGrid grid;
  grid.Build(solids.spheres, solids.boxes);
  TouchedSpheres found;
  EXPECT_FALSE(grid.FindTouched({packet, {}, 5}, found));

  solids.spheres[0].centre.y = std::numeric_limits<double>::quiet_NaN();
  grid.Build(solids.spheres, solids.boxes);
  found.count = 0;
  EXPECT_FALSE(grid.FindTouched({packet, {}, 5}, found));
  EXPECT_EQ(found.count, 0u);
}

}  // namespace
}  // namespace gsv::sensing
