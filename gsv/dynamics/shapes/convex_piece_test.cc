#include "gsv/dynamics/shapes/convex_piece.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "gsv/base/random.h"

namespace gsv::dynamics {
namespace {

ConvexPiece Rectangle(double x, double y, double half_length, double half_width) {
  return Hull({{x - half_length, y - half_width},
               {x + half_length, y - half_width},
               {x + half_length, y + half_width},
               {x - half_length, y + half_width}});
}

TEST(Separate, OfDiscsIsTheGapBetweenThem) {
  const Separation s = Separate(Disc({0, 0}, 1), Disc({3, 4}, 2));
  EXPECT_NEAR(s.distance, 2, 1e-15);
  EXPECT_NEAR(s.normal.x, 0.6, 1e-15);
  EXPECT_NEAR(s.normal.y, 0.8, 1e-15);
  EXPECT_NEAR(s.point.x, 0.6 * 2, 1e-15);  // halfway between the discs' edges, 1 and 3
  EXPECT_NEAR(Separate(Disc({0, 0}, 1), Disc({1, 0}, 1)).distance, -1, 1e-15);
}

TEST(Separate, OfADiscAndAPolygonIsMeasuredToFaceOrCorner) {
  const ConvexPiece box = Rectangle(0, 0, 2, 1);
  EXPECT_NEAR(Separate(Disc({5, 0.5}, 1), box).distance, 2, 1e-15);
  EXPECT_NEAR(Separate(Disc({5, 5}, 1), box).distance, 4, 1e-15);
  EXPECT_NEAR(Separate(Disc({1.5, 0}, 0.25), box).distance, -0.75, 1e-15);  // 0.5 inside the box,
                                                                            // plus the disc's
                                                                            // radius
  EXPECT_NEAR(Separate(box, Disc({5, 0.5}, 1)).normal.x, 1, 1e-15);
}

TEST(Separate, OfPolygonsIsTheDistanceOrThePenetration) {
  const ConvexPiece box = Rectangle(0, 0, 2, 1);
  EXPECT_NEAR(Separate(box, Rectangle(5, 0, 1, 1)).distance, 2, 1e-15);
  EXPECT_NEAR(Separate(box, Rectangle(6, 5, 1, 1)).distance, std::hypot(3, 3), 1e-15);
  const Separation overlap = Separate(box, Rectangle(2.5, 0, 1, 3));
  EXPECT_NEAR(overlap.distance, -0.5, 1e-15);
  EXPECT_NEAR(overlap.normal.x, 1, 1e-15);
}

TEST(Separate, OfSegmentsConsidersTheirEnds) {
  const ConvexPiece segment = Hull({{-1, 0}, {1, 0}});
  EXPECT_EQ(segment.vertex_count, 2);
  EXPECT_NEAR(Separate(Disc({3, 0}, 0.5), segment).distance, 1.5, 1e-15);
  EXPECT_NEAR(Separate(Hull({{0, -1}, {0, 1}}), segment).distance, -1, 1e-15);  // crossing
  EXPECT_NEAR(Separate(Hull({{4, -1}, {4, 1}}), segment).distance, 3, 1e-15);
  EXPECT_NEAR(Separate(Rectangle(3, 0, 1, 1), segment).distance, 1, 1e-15);
}

TEST(Separate, IsExactToAMicrometreBesideALongWall) {
  const ConvexPiece wall = Rectangle(100, 0.05, 200, 0.05);
  const ConvexPiece box = Rectangle(37.3, -0.2 - 1e-6, 0.3, 0.2);
  const Separation s = Separate(box, wall);
  EXPECT_NEAR(s.distance, 1e-6, 1e-12);
  EXPECT_NEAR(s.normal.x, 0, 1e-12);
  EXPECT_NEAR(s.normal.y, 1, 1e-12);
}

ConvexPiece RandomPiece(base::Noise& noise) {
  const int count = 1 + static_cast<int>(noise.Uniform() * 7);
  std::vector<Vector2> points;
  points.reserve(static_cast<std::size_t>(count));
  const Vector2 centre{2 * noise.Uniform(), 2 * noise.Uniform()};
  for (int i = 0; i < count; ++i)
    points.push_back(centre + Vector2{noise.Uniform(), noise.Uniform()});
  ConvexPiece piece = Hull(points);
  piece.radius = noise.Uniform() < 0.5 ? 0 : 0.3 * noise.Uniform();
  return piece;
}

// The extent of a piece along an axis, computed from its definition.
double Top(const ConvexPiece& piece, Vector2 axis) {
  double top = -1e9;
  for (const Vector2 v : piece.points()) top = std::max(top, Dot(v, axis));
  return top + piece.radius;
}

// The distance by the separating axis theorem: the largest gap between the convex sets along any
// axis.
double LargestGap(const ConvexPiece& a, const ConvexPiece& b) {
  double largest = -1e9, step = 2 * std::numbers::pi / 3600, best_angle = 0;
  for (const double finer : {1.0, 1e-3, 1e-6}) {
    const double centre = best_angle, width = finer == 1 ? 1800 : 1000;
    for (double i = -width; i <= width; ++i) {
      const double angle = centre + i * step * finer;
      const Vector2 axis{std::cos(angle), std::sin(angle)};
      const double gap = -Top(b, -1.0 * axis) - Top(a, axis);
      if (gap > largest) largest = gap, best_angle = angle;
    }
  }
  return largest;
}

TEST(Separate, IsTheLargestGapAlongAnyAxis) {
  base::Noise noise(3, 4, 5);
  int apart = 0;
  for (int i = 0; i < 60; ++i) {
    const ConvexPiece a = RandomPiece(noise), b = RandomPiece(noise);
    const Separation s = Separate(a, b);
    EXPECT_NEAR(s.distance, LargestGap(a, b), 1e-6) << i;
    EXPECT_NEAR(Separate(b, a).distance, s.distance, 1e-12) << i;
    EXPECT_NEAR(-Top(b, -1.0 * s.normal) - Top(a, s.normal), s.distance, 1e-9) << i;
    apart += s.distance > 0;
    const double to_point = Separate(a, Disc(b.vertices[0], 0)).distance;
    EXPECT_NEAR(DistanceTo(a, b.vertices[0]), std::max(to_point, 0.0), 1e-12) << i;
  }
  EXPECT_GT(apart, 10);
  EXPECT_LT(apart, 50);
}

TEST(Hull, KeepsCornersOnlyAndTurnsCounterClockwise) {
  const ConvexPiece hull = Hull({{0, 0}, {2, 0}, {1, 0}, {2, 2}, {1, 1}, {0, 2}, {0, 1}});
  ASSERT_EQ(hull.vertex_count, 4);
  for (int i = 0; i < 4; ++i) {
    const Vector2 a = hull.vertices[i], b = hull.vertices[(i + 1) % 4],
                  c = hull.vertices[(i + 2) % 4];
    EXPECT_GT(Cross(b - a, c - b), 0);
  }
}

TEST(Hull, OfManyCornersEnclosesThemTightly) {
  constexpr int kCorners = 100;
  std::vector<Vector2> points;
  points.reserve(kCorners);
  for (int i = 0; i < kCorners; ++i) points.push_back({std::cos(0.0628 * i), std::sin(0.0628 * i)});
  const ConvexPiece hull = Hull(points);
  EXPECT_LE(hull.vertex_count, ConvexPiece::kMaxVertices);
  for (const Vector2 p : points) EXPECT_LE(Separate(Disc(p, 0), hull).distance, 1e-9);
  for (const Vector2 v : hull.points()) EXPECT_LE(std::sqrt(Dot(v, v)), 1.02);
}

TEST(Contains, IsTrueForInnerPoints) {
  EXPECT_TRUE(Contains(Disc({0, 0}, 1), Rectangle(0, 0, 0.7, 0.7), 0));
  EXPECT_FALSE(Contains(Disc({0, 0}, 1), Rectangle(0, 0, 0.8, 0.7), 0));
  EXPECT_TRUE(Contains(Rectangle(0, 0, 1, 1), Disc({0.5, 0}, 0.5), 1e-12));
  EXPECT_FALSE(Contains(Rectangle(0, 0, 1, 1), Disc({0.6, 0}, 0.5), 1e-12));
}

}  // namespace
}  // namespace gsv::dynamics
