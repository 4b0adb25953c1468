#include "gsv/sensing/rays/ray_shape.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "gsv/base/random.h"
#include "gsv/base/test_within.h"

namespace gsv::sensing {
namespace {

using geometry::Shape;
using geometry::Vector3;

constexpr double kFar = 100;

double DistanceTo(const Shape& shape, const Vector3& origin, const Vector3& direction) {
  return DistanceToShape({origin, Normalized(direction), kFar}, shape).value_or(-1);
}

TEST(RayShape, HitsTheFaceOfABoxFromOutsideAndInside) {
  const geometry::Box box{{2, 4, 6}};
  EXPECT_DOUBLE_EQ(DistanceTo(box, {5, 0, 0}, {-1, 0, 0}), 4);
  EXPECT_DOUBLE_EQ(DistanceTo(box, {0, 0, 0}, {0, 1, 0}), 2);
  EXPECT_DOUBLE_EQ(DistanceTo(box, {5, 0, 0}, {1, 0, 0}), -1);
  EXPECT_DOUBLE_EQ(DistanceTo(box, {5, 3, 0}, {-1, 0, 0}), -1);
  EXPECT_EQ(NormalOfShape({{5, 0, 0}, {-1, 0, 0}, kFar}, box), (Vector3{1, 0, 0}));
  EXPECT_EQ(NormalOfShape({{0, 0, 0}, {-1, 0, 0}, kFar}, box), (Vector3{1, 0, 0}));
}

TEST(RayShape, RespectsTheLengthOfTheRay) {
  const geometry::Sphere sphere{1};
  EXPECT_TRUE(DistanceToShape({{3, 0, 0}, {-1, 0, 0}, 2}, sphere));
  EXPECT_FALSE(DistanceToShape({{3, 0, 0}, {-1, 0, 0}, 1.999}, sphere));
}

TEST(RayShape, HitsRoundShapesAtTheRootsOfTheirEquations) {
  // At the height 0.6, the half width of a unit sphere is 0.8.
  EXPECT_WITHIN(DistanceTo(geometry::Sphere{1}, {5, 0, 0.6}, {-1, 0, 0}), 4.2, 1e-12, "m");
  EXPECT_WITHIN(DistanceTo(geometry::Cylinder{1, 2}, {5, 0.6, 0.5}, {-1, 0, 0}), 4.2, 1e-12, "m");
  EXPECT_WITHIN(DistanceTo(geometry::Cylinder{1, 2}, {0.5, 0, 9}, {0, 0, -1}), 8, 1e-12, "m");
  EXPECT_WITHIN(DistanceTo(geometry::Capsule{1, 2}, {0, 0, 9}, {0, 0, -1}), 7, 1e-12, "m");
  EXPECT_WITHIN(DistanceTo(geometry::Capsule{1, 2}, {0.6, 0, 9}, {0, 0, -1}), 7.2, 1e-12, "m");
  EXPECT_WITHIN(DistanceTo(geometry::Ellipsoid{{1, 2, 3}}, {0, 0, 9}, {0, 0, -1}), 6, 1e-12, "m");
  EXPECT_WITHIN(DistanceTo(geometry::Ellipsoid{{1, 2, 3}}, {9, 1.2, 0}, {-1, 0, 0}), 8.2, 1e-12,
                "m");
  // Halfway up, a cone is half as wide.
  EXPECT_WITHIN(DistanceTo(geometry::Cone{1, 2}, {5, 0, 0}, {-1, 0, 0}), 4.5, 1e-12, "m");
  EXPECT_WITHIN(DistanceTo(geometry::Cone{1, 2}, {0.5, 0, 9}, {0, 0, -1}), 9, 1e-12, "m");
  EXPECT_WITHIN(DistanceTo(geometry::Cone{1, 2}, {0.5, 0, -9}, {0, 0, 1}), 8, 1e-12, "m");
  EXPECT_WITHIN(DistanceTo(geometry::Plane{}, {3, 4, 2}, {0, 0.6, -0.8}), 2.5, 1e-12, "m");
  EXPECT_WITHIN(DistanceTo(geometry::Plane{}, {3, 4, -2}, {0, 0, 1}), 2, 1e-12, "m");
}

TEST(RayShape, HitsATriangleAndItsEdgeButNotBesideIt) {
  const Triangle triangle{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  const auto cast = [&](double x, double y) {
    return DistanceToTriangle({{x, y, 2}, {0, 0, -1}, kFar}, triangle);
  };
  EXPECT_EQ(cast(0.2, 0.3), 2);
  EXPECT_EQ(NormalOfTriangle({{0.2, 0.3, 2}, {0, 0, -1}, kFar}, triangle), (Vector3{0, 0, 1}));
  EXPECT_TRUE(cast(0.5, 0.5));
  EXPECT_TRUE(cast(0, 0));
  EXPECT_FALSE(cast(0.51, 0.5));
  EXPECT_FALSE(cast(-1e-9, 0.5));
}

// The implicit function of a shape: negative inside, positive outside, 0 on the surface.
struct Implicit {
  Vector3 p;
  double operator()(const geometry::Box& b) const {
    return std::max(
        {std::abs(p.x) - b.size.x / 2, std::abs(p.y) - b.size.y / 2, std::abs(p.z) - b.size.z / 2});
  }
  double operator()(const geometry::Sphere& s) const { return Norm(p) - s.radius; }
  double operator()(const geometry::Cylinder& c) const {
    return std::max(std::hypot(p.x, p.y) - c.radius, std::abs(p.z) - c.length / 2);
  }
  double operator()(const geometry::Capsule& c) const {
    const double z = std::clamp(p.z, -c.length / 2, c.length / 2);
    return Norm(p - Vector3{0, 0, z}) - c.radius;
  }
  double operator()(const geometry::Ellipsoid& e) const {
    return Norm(Vector3{p.x / e.radii.x, p.y / e.radii.y, p.z / e.radii.z}) - 1;
  }
  double operator()(const geometry::Cone& c) const {
    const double width = c.radius * (c.length / 2 - p.z) / c.length;
    return std::max(std::hypot(p.x, p.y) - width, -c.length / 2 - p.z);
  }
  double operator()(const geometry::Plane& plane) const { return Dot(p, plane.normal); }
  double operator()(const geometry::Mesh&) const { return 1; }
};

// Returns the distance to the first change of sign along the ray, which is found by steps and
// bisection; negative if there is none.
double MarchedDistance(const Shape& shape, const Ray& ray) {
  const auto side = [&](double t) {
    return std::visit(Implicit{ray.origin + t * ray.direction}, shape) > 0;
  };
  constexpr double kStep = 0.002;
  const bool at_start = side(0);
  for (double t = kStep; t < ray.max_distance; t += kStep) {
    if (side(t) == at_start) continue;
    double low = t - kStep, high = t;
    for (int i = 0; i < 60; ++i) {
      const double middle = (low + high) / 2;
      (side(middle) == at_start ? low : high) = middle;
    }
    return high;
  }
  return -1;
}

TEST(RayShape, AgreesWithMarchingAlongRandomRays) {
  const std::vector<Shape> shapes = {geometry::Box{{1, 2, 0.5}},
                                     geometry::Sphere{0.8},
                                     geometry::Cylinder{0.6, 1.5},
                                     geometry::Capsule{0.4, 1.2},
                                     geometry::Ellipsoid{{0.5, 0.9, 1.3}},
                                     geometry::Cone{0.9, 1.6},
                                     geometry::Plane{Normalized(Vector3{1, 2, 3}), {1, 1}}};
  base::Noise noise(7, 0, 0);
  const auto uniform = [&](double low, double high) {
    return low + (high - low) * noise.Uniform();
  };
  int hits = 0;
  for (int i = 0; i < 1400; ++i) {
    const Shape& shape = shapes[i % shapes.size()];
    const Vector3 origin{uniform(-2, 2), uniform(-2, 2), uniform(-2, 2)};
    const Vector3 target{uniform(-0.8, 0.8), uniform(-0.8, 0.8), uniform(-0.8, 0.8)};
    Ray ray{origin, Normalized(target - origin), 4};
    if (i % 5 == 0) ray.direction = {0, 0, i % 2 ? 1.0 : -1.0};
    const auto hit = DistanceToShape(ray, shape);
    const double marched = MarchedDistance(shape, ray);
    if (marched >= 0) {
      ++hits;
      ASSERT_TRUE(hit) << i;
      ASSERT_LE(*hit, marched + 1e-9) << i;
      const Vector3 normal = NormalOfShape(ray, shape);
      ASSERT_LE(Dot(normal, ray.direction), 0) << i;
      ASSERT_NEAR(Norm(normal), 1, 1e-12) << i;
    }
    if (hit) {  // a hit is on the surface, even if the steps have missed a short chord
      const Vector3 p = ray.origin + *hit * ray.direction;
      ASSERT_WITHIN(std::visit(Implicit{p}, shape), 0, 1e-9, "m") << i;
    }
  }
  EXPECT_GT(hits, 700);
}

}  // namespace
}  // namespace gsv::sensing
