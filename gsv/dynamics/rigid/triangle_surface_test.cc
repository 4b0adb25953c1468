// Tests contacts of wheels and spheres with triangles against closed forms and a brute-force
// search.
#include "gsv/dynamics/rigid/triangle_surface.h"

#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "gsv/dynamics/rigid/mesh_points.h"
#include "gsv/geometry/constants.h"

namespace gsv::dynamics {
namespace {

using geometry::TriangleMesh;
using geometry::Vector3;

constexpr double kMargin = 1e-3;

// Squares around the origin, by default of 0.25 m, with the heights of `height`, each of two
// triangles.
template <typename Height>
TriangleMesh Grid(const Height& height, int count = 8, double size = 0.25) {
  TriangleMesh mesh;
  for (int row = 0; row <= count; ++row) {
    for (int column = 0; column <= count; ++column) {
      const double x = size * (column - count / 2), y = size * (row - count / 2);
      mesh.positions.push_back({x, y, height(x, y)});
    }
  }
  const auto corner = [&](int row, int column) {
    return static_cast<std::uint32_t>(row * (count + 1) + column);
  };
  for (int row = 0; row < count; ++row) {
    for (int column = 0; column < count; ++column) {
      const auto a = corner(row, column), b = corner(row, column + 1);
      const auto c = corner(row + 1, column + 1), d = corner(row + 1, column);
      mesh.triangles.push_back({a, b, c});
      mesh.triangles.push_back({a, c, d});
    }
  }
  return mesh;
}

// Vertices are not shared, as in files such as STL.
TriangleMesh WithOwnVertices(const TriangleMesh& mesh) {
  TriangleMesh own;
  for (const auto& triangle : mesh.triangles) {
    const auto first = static_cast<std::uint32_t>(own.positions.size());
    for (const auto corner : triangle) own.positions.push_back(mesh.positions[corner]);
    own.triangles.push_back({first, first + 1, first + 2});
  }
  return own;
}

// Each triangle has a second triangle for its back, as in meshes for rendering.
TriangleMesh WithBacks(TriangleMesh mesh) {
  const auto fronts = mesh.triangles;
  for (const auto& [a, b, c] : fronts) mesh.triangles.push_back({a, c, b});
  return mesh;
}

Piece PieceOf(Piece::Kind kind, double radius, double half) {
  Piece piece;
  piece.kind = kind;
  piece.half = {radius, radius, half};
  return piece;
}

const Piece kWheel = PieceOf(Piece::Kind::kCylinder, 0.12, 0.04);
const Piece kBall = PieceOf(Piece::Kind::kSphere, 0.1, 0);
const Matrix3 kAxleAlongY = MatrixOf(geometry::FromAxisAngle({1, 0, 0}, -geometry::kPi / 2));

std::vector<TouchPoint> Touch(const Piece& piece, const Vector3& position, const Matrix3& rotation,
                              const TriangleMesh& mesh) {
  const TriangleSurface surface(mesh, {1, 1, 1});
  Piece ground;
  ground.kind = Piece::Kind::kMesh;
  ground.triangles = &surface;
  std::vector<TouchPoint> points;
  EXPECT_TRUE(
      AddTouchPoints(Place(piece, position, rotation), Place(ground, {}, {}), kMargin, points));
  return points;
}

TEST(TriangleSurface, WheelOnLevelTrianglesTouchesThemAsAPlane) {
  const TriangleMesh level = Grid([](double, double) { return 0.0; });
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> place(-0.6, 0.6), turn(-3, 3), lean(-0.05, 0.05);
  Piece plane = PieceOf(Piece::Kind::kPlane, 0, 0);
  plane.normal = {0, 0, 1};
  for (int i = 0; i < 300; ++i) {
    const Matrix3 rotation = MatrixOf(geometry::FromAxisAngle({0, 0, 1}, turn(random))) *
                             MatrixOf(geometry::FromAxisAngle({1, 0, 0}, lean(random))) *
                             kAxleAlongY;
    const Vector3 at{place(random), place(random), 0.1195};
    std::vector<TouchPoint> expected;
    AddTouchPoints(Place(kWheel, at, rotation), Place(plane, {}, {}), kMargin, expected);
    for (const TriangleMesh& mesh : {level, WithOwnVertices(level), WithBacks(level)}) {
      const auto points = Touch(kWheel, at, rotation, mesh);
      ASSERT_EQ(points.size(), expected.size());
      for (const TouchPoint& point : points) {
        EXPECT_EQ(point.normal, (Vector3{0, 0, 1}));
        EXPECT_TRUE(std::any_of(expected.begin(), expected.end(), [&](const TouchPoint& of) {
          return Norm(of.on_second - point.on_second) < 1e-12 &&
                 std::abs(of.distance - point.distance) < 1e-12;
        }));
      }
    }
  }
}

TEST(TriangleSurface, WheelOnFineLevelTrianglesTouchesThemAsAPlane) {
  const TriangleMesh fine = Grid([](double, double) { return 0.0; }, 100, 2e-3);
  for (const double turn : {0.0, 0.3, 1.2}) {
    const Matrix3 rotation = MatrixOf(geometry::FromAxisAngle({0, 0, 1}, turn)) * kAxleAlongY;
    const auto points = Touch(kWheel, {1e-4, 2e-4, 0.11999}, rotation, fine);
    ASSERT_EQ(points.size(), 2u);
    EXPECT_NEAR(Norm(points[0].on_second - points[1].on_second), 2 * kWheel.half.z, 1e-12);
    for (const TouchPoint& point : points) EXPECT_NEAR(point.distance, -1e-5, 1e-12);
  }
}

TEST(TriangleSurface, RoughFineMeshGivesTheDeepestAndFewOtherPoints) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> bump(-2e-4, 0);
  const TriangleMesh rough = Grid([&](double, double) { return bump(random); }, 100, 2e-3);
  TriangleMesh reversed = rough;
  std::reverse(reversed.triangles.begin(), reversed.triangles.end());
  for (const Piece* piece : {&kWheel, &kBall}) {
    const Vector3 at{0, 0, piece->half.x - 1e-4};
    const PlacedPiece placed = Place(*piece, at, kAxleAlongY);
    double deepest = 1;
    for (const Vector3& vertex : rough.positions) {
      const Vector3 from = TransposeTimes(placed.rotation, vertex - at);
      const double along = piece == &kBall ? from.z : std::max(0.0, std::abs(from.z) - 0.04);
      deepest = std::min(deepest, std::hypot(from.x, from.y, along) - piece->half.x);
    }
    const auto points = Touch(*piece, at, kAxleAlongY, rough);
    EXPECT_LE(points.size(), MeshPoints::kMaxPoints);
    EXPECT_NEAR(points.at(0).distance, deepest, 1e-12);
    double left = 0, right = 0;
    for (const TouchPoint& point : points) {
      left = std::max(left, point.on_second.y);
      right = std::min(right, point.on_second.y);
    }
    // The wheel is carried near both rims.
    if (piece == &kWheel) {
      EXPECT_GT(std::min(left, -right), 0.03);
    }
    const auto same = Touch(*piece, at, kAxleAlongY, reversed);
    ASSERT_EQ(same.size(), points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
      EXPECT_NEAR(Norm(same[i].on_second - points[i].on_second), 0, 1e-12);
    }
  }
}

TEST(TriangleSurface, WheelBesideAStepStandsOnItsEdge) {
  // The step is 0.25 m high, at x = 0; the wheel overhangs it by a half of its width.
  TriangleMesh step;
  step.positions = {{-1, -1, 0},    {0, -1, 0},    {0, 1, 0},      {-1, 1, 0},
                    {0, -1, -0.25}, {0, 1, -0.25}, {1, -1, -0.25}, {1, 1, -0.25}};
  step.triangles = {{0, 1, 2}, {0, 2, 3}, {1, 4, 5}, {1, 5, 2}, {4, 6, 7}, {4, 7, 5}};
  const Matrix3 axle_along_x = MatrixOf(geometry::FromAxisAngle({0, 1, 0}, geometry::kPi / 2));
  auto points = Touch(kWheel, {0, 0.1, 0.11999}, axle_along_x, step);
  ASSERT_EQ(points.size(), 2u);
  if (points[0].on_second.x > points[1].on_second.x) std::swap(points[0], points[1]);
  EXPECT_NEAR(points[0].on_second.x, -0.04, 1e-9);
  EXPECT_NEAR(points[1].on_second.x, 0, 1e-9);
  for (const TouchPoint& point : points) {
    EXPECT_NEAR(point.normal.z, 1, 1e-9);
    EXPECT_NEAR(point.distance, -1e-5, 1e-9);
  }
}

TEST(TriangleSurface, WheelAgainstAWallTouchesItWithBothRims) {
  TriangleMesh wall;
  wall.positions = {{0, -1, -1}, {0, 1, -1}, {0, 1, 1}, {0, -1, 1}};
  wall.triangles = {{0, 1, 2}, {0, 2, 3}};
  for (const double side : {-1.0, 1.0}) {
    const auto points = Touch(kWheel, {side * 0.1199, 0.1, 0.2}, kAxleAlongY, wall);
    ASSERT_EQ(points.size(), 2u);
    for (const TouchPoint& point : points) {
      EXPECT_NEAR(point.normal.x, side, 1e-12);
      EXPECT_NEAR(point.distance, -1e-4, 1e-9);
      EXPECT_NEAR(point.on_second.z, 0.2, 1e-9);
    }
  }
}

TEST(TriangleSurface, WheelOnARidgeTouchesItAcrossItsWidth) {
  const TriangleMesh ridge = Grid([](double x, double) { return -0.3 * std::abs(x); });
  const auto points =
      Touch(kWheel, {0.003, 0.1, std::sqrt(0.12 * 0.12 - 0.003 * 0.003)}, kAxleAlongY, ridge);
  ASSERT_EQ(points.size(), 2u);
  for (const TouchPoint& point : points) {
    EXPECT_NEAR(point.on_second.x, 0, 1e-12);
    EXPECT_NEAR(std::abs(point.on_second.y - 0.1), 0.04, 1e-12);
    EXPECT_NEAR(point.normal.x, 0.003 / 0.12, 1e-9);
    EXPECT_NEAR(point.distance, 0, 1e-12);
  }
}

// Returns the distance of the piece from a point that is outside, or slightly inside.
double DistanceFrom(const PlacedPiece& piece, const Vector3& point) {
  const Vector3 at = TransposeTimes(piece.rotation, point - piece.position);
  if (piece.piece->kind == Piece::Kind::kSphere) return Norm(at) - piece.piece->half.x;
  const double out = std::sqrt(at.x * at.x + at.y * at.y) - piece.piece->half.x;
  const double beyond = std::abs(at.z) - piece.piece->half.z;
  if (out > 0 && beyond > 0) return std::sqrt(out * out + beyond * beyond);
  return std::max(out, beyond);
}

template <typename Function>
double Least(const Function& function) {
  const double ratio = (std::sqrt(5.0) - 1) / 2;
  double low = 0, high = 1, a = 1 - ratio, b = ratio, at_a = function(a), at_b = function(b);
  for (int i = 0; i < 45; ++i) {
    if (at_a < at_b) {
      high = b, b = a, at_b = at_a, a = high - ratio * (high - low), at_a = function(a);
    } else {
      low = a, a = b, at_a = at_b, b = low + ratio * (high - low), at_b = function(b);
    }
  }
  return std::min(at_a, at_b);
}

// Returns the distance between the piece and the mesh. The distance of a point from a convex shape
// is a convex function of the point, so Least() finds its minimum over each triangle.
double LeastDistance(const PlacedPiece& piece, const TriangleMesh& mesh) {
  double least = 1;
  for (const auto& [i, j, k] : mesh.triangles) {
    const Vector3 a = mesh.positions[i], b = mesh.positions[j], c = mesh.positions[k];
    const Vector3 low{std::min({a.x, b.x, c.x}), std::min({a.y, b.y, c.y}), 0};
    const Vector3 high{std::max({a.x, b.x, c.x}), std::max({a.y, b.y, c.y}), 0};
    if (low.x > piece.high.x || high.x < piece.low.x || low.y > piece.high.y ||
        high.y < piece.low.y) {
      continue;
    }
    least = std::min(least, Least([&](double s) {
                       return Least([&](double t) {
                         return DistanceFrom(piece, a + s * (b - a) + s * t * (c - b));
                       });
                     }));
  }
  return least;
}

void ExpectNearestPoints(const Piece& piece, double largest_lean, double bound) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> place(-0.4, 0.4), turn(-3, 3);
  std::uniform_real_distribution<double> lean(-largest_lean, largest_lean), bump(-0.06, 0.06);
  for (int i = 0; i < 60; ++i) {
    const TriangleMesh mesh = Grid([&](double, double) { return bump(random); });
    const Matrix3 rotation = MatrixOf(geometry::FromAxisAngle({0, 0, 1}, turn(random))) *
                             MatrixOf(geometry::FromAxisAngle({1, 0, 0}, lean(random))) *
                             kAxleAlongY;
    Vector3 at{place(random), place(random), 0.5};
    // Lowers the piece until it is a hundredth of a millimetre from the triangles.
    double distance = LeastDistance(Place(piece, at, rotation), mesh);
    for (int k = 0; k < 60 && distance > 1e-5; ++k) {
      at.z -= distance - 0.9e-5;
      distance = LeastDistance(Place(piece, at, rotation), mesh);
    }
    const auto points = Touch(piece, at, rotation, mesh);
    double nearest = 1;
    for (const TouchPoint& point : points) {
      nearest = std::min(nearest, point.distance);
      EXPECT_NEAR(DistanceFrom(Place(piece, at, rotation), point.on_second), point.distance, bound);
    }
    EXPECT_NEAR(nearest, distance, bound) << "case " << i << ", " << points.size() << " points";
  }
}

TEST(TriangleSurface, NearestPointOfASphereEqualsABruteForceSearch) {
  ExpectNearestPoints(kBall, 0, 1e-9);
}

TEST(TriangleSurface, NearestPointOfAWheelEqualsABruteForceSearch) {
  ExpectNearestPoints(kWheel, 0.3, 1e-6);
}

// Without a list of checked vertices, the search would check all neighbours of the tip once for
// each triangle.
TEST(TriangleSurface, TipOfManyTrianglesIsFoundOnce) {
  constexpr int kCount = 20'000;
  TriangleMesh fan;
  fan.positions.push_back({0, 0, 0});
  for (int i = 0; i < kCount; ++i) {
    const double angle = 2 * geometry::kPi * i / kCount;
    fan.positions.push_back({std::cos(angle), std::sin(angle), -1});
  }
  for (std::uint32_t i = 0; i < kCount; ++i) {
    fan.triangles.push_back({0, 1 + i, 1 + (i + 1) % kCount});
  }
  const auto points = Touch(kBall, {0, 0, 0.1}, {}, fan);
  ASSERT_EQ(points.size(), 1u);
  EXPECT_NEAR(points[0].normal.z, 1, 1e-12);
}

TEST(TriangleSurface, BallRollsOverInnerEdgesAndIsNotCaught) {
  const TriangleMesh level = Grid([](double, double) { return 0.0; });
  for (const TriangleMesh& mesh : {level, WithBacks(level)}) {
    for (double x = -0.3; x < 0.3; x += 0.003) {
      // The ball penetrates the ground, so the triangles ahead of it are nearer than its radius.
      const auto points = Touch(kBall, {x, 0.4 * x, 0.0995}, {}, mesh);
      ASSERT_EQ(points.size(), 1u);
      EXPECT_NEAR(points[0].normal.z, 1, 1e-12);
      EXPECT_NEAR(points[0].distance, -5e-4, 1e-12);
    }
  }
}

}  // namespace
}  // namespace gsv::dynamics
