#include "gsv/geometry/distance.h"

#include <cmath>

#include <gtest/gtest.h>

namespace gsv::geometry {
namespace {

struct Case {
  const char* name;
  Shape shape;
  Vector3 point;
  double distance;
};

Shape RightTriangle() {
  auto mesh = std::make_shared<TriangleMesh>();
  mesh->positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh->triangles = {{0, 1, 2}};
  return Mesh{mesh, {2, 2, 2}};
}

TEST(Distance, IsMeasuredToTheNearestPointOfTheSurface) {
  const double root = std::sqrt(2.0);
  const Case cases[] = {
      {"box, before a face", Box{{2, 4, 6}}, {3, 0, 0}, 2},
      {"box, before an edge", Box{{2, 4, 6}}, {2, 3, 0}, root},
      {"box, inside", Box{{2, 4, 6}}, {0.75, 0, 0}, -0.25},
      {"sphere", Sphere{2}, {3, 0, 4}, 3},
      {"cylinder, beside", Cylinder{1, 4}, {0, 3, 1}, 2},
      {"cylinder, above", Cylinder{1, 4}, {0, 0.5, 3}, 1},
      {"cylinder, before the rim", Cylinder{1, 4}, {2, 0, 3}, root},
      {"cylinder, inside", Cylinder{1, 4}, {0, 0, 1.75}, -0.25},
      {"capsule, above", Capsule{1, 4}, {0, 0, 5}, 2},
      {"capsule, beside", Capsule{1, 4}, {3, 0, 1}, 2},
      {"ellipsoid, on its surface", Ellipsoid{{3, 2, 1}}, {0, 2, 0}, 0},
      {"ellipsoid, at its centre", Ellipsoid{{3, 2, 1}}, {0, 0, 0}, -1},
      {"cone, below", Cone{1, 2}, {0.5, 0, -3}, 2},
      {"cone, before the slope", Cone{2, 2}, {2, 0, 1}, root},
      {"cone, inside", Cone{2, 2}, {0, 0, -0.75}, -0.25},
      {"plane, above", Plane{}, {5, 5, 2}, 2},
      {"plane, below", Plane{}, {5, 5, -2}, -2},
      {"triangle, above its face", RightTriangle(), {0.5, 0.5, 3}, 3},
      {"triangle, before its long side", RightTriangle(), {2, 2, 0}, root},
      {"triangle, before a corner", RightTriangle(), {5, 0, 4}, 5},
  };
  for (const Case& each : cases) {
    EXPECT_NEAR(DistanceTo(each.shape, each.point), each.distance, 1e-12) << each.name;
  }
}

TEST(Distance, IsInfiniteToAMeshWithoutTriangles) {
  EXPECT_EQ(DistanceTo(Mesh{std::make_shared<TriangleMesh>(), {1, 1, 1}}, {}), INFINITY);
}

}  // namespace
}  // namespace gsv::geometry
