#include "gsv/dynamics/shapes/silhouette.h"

#include <cmath>

#include <gtest/gtest.h>

#include "gsv/geometry/constants.h"

namespace gsv::dynamics {
namespace {

using geometry::FromAxisAngle;
using geometry::Pose;

using geometry::kPi;

// The extent of a piece along x and y.
double ReachX(const ConvexPiece& piece) {
  double reach = -1e9;
  for (const Vector2 v : piece.points()) reach = std::max(reach, v.x);
  return reach + piece.radius;
}
double ReachY(const ConvexPiece& piece) {
  double reach = -1e9;
  for (const Vector2 v : piece.points()) reach = std::max(reach, v.y);
  return reach + piece.radius;
}

TEST(Silhouette, OfAnUprightCylinderIsADisc) {
  const ConvexPiece piece =
      Silhouette(geometry::Cylinder{0.3, 1}, geometry::PlanarPose(1, 2, 3, 0.4));
  EXPECT_EQ(piece.vertex_count, 1);
  EXPECT_EQ(piece.radius, 0.3);
  EXPECT_EQ(piece.vertices[0], (Vector2{1, 2}));
}

TEST(Silhouette, OfALyingCylinderIsARectangle) {
  const Pose lying{{0, 0, 0}, FromAxisAngle({1, 0, 0}, kPi / 2)};  // the shape's axis is along y
  const ConvexPiece piece = Silhouette(geometry::Cylinder{0.3, 1}, lying);
  EXPECT_EQ(piece.vertex_count, 4);
  EXPECT_NEAR(ReachX(piece), 0.3, 1e-9);
  EXPECT_NEAR(ReachY(piece), 0.5, 1e-9);
}

TEST(Silhouette, OfALyingCapsuleIsAStadium) {
  const Pose lying{{0, 0, 0}, FromAxisAngle({0, 1, 0}, kPi / 2)};
  const ConvexPiece piece = Silhouette(geometry::Capsule{0.3, 1}, lying);
  EXPECT_EQ(piece.vertex_count, 2);
  EXPECT_NEAR(ReachX(piece), 0.8, 1e-12);
  EXPECT_NEAR(ReachY(piece), 0.3, 1e-12);
}

TEST(Silhouette, OfARotatedBoxHasItsCorners) {
  const ConvexPiece piece =
      Silhouette(geometry::Box{{2, 1, 1}}, geometry::PlanarPose(0, 0, 0, kPi / 4));
  EXPECT_EQ(piece.vertex_count, 4);
  EXPECT_NEAR(ReachX(piece), 1.5 / std::sqrt(2), 1e-12);
}

TEST(Heights, EqualThoseOfTheShape) {
  const Pose askew{{0, 0, 1}, FromAxisAngle({1, 0, 0}, kPi / 6)};
  const Interval heights = Heights(geometry::Cylinder{0.3, 1}, askew);
  const double expected = 0.5 * std::cos(kPi / 6) + 0.3 * std::sin(kPi / 6);
  EXPECT_NEAR(heights.high, 1 + expected, 1e-12);
  EXPECT_NEAR(heights.low, 1 - expected, 1e-12);
}

std::vector<ConvexPiece> Sliced(const geometry::Shape& shape, const Pose& pose, Interval heights) {
  std::vector<ConvexPiece> pieces;
  Slice(shape, pose, heights, pieces);
  return pieces;
}

TEST(Slice, OfASphereIsItsWidestCircleBetweenTheHeights) {
  const geometry::Sphere sphere{1};
  EXPECT_NEAR(Sliced(sphere, {}, {0.6, 2})[0].radius, 0.8, 1e-12);
  EXPECT_NEAR(Sliced(sphere, {}, {-0.6, 0.2})[0].radius, 1, 1e-12);
  EXPECT_TRUE(Sliced(sphere, {}, {1, 2}).empty());
}

TEST(Slice, OfAConeIsWidestAtItsBase) {
  EXPECT_NEAR(Sliced(geometry::Cone{1, 2}, {}, {0, 5})[0].radius, 0.5, 1e-12);
  const Pose upside_down{{0, 0, 0}, FromAxisAngle({1, 0, 0}, kPi)};
  EXPECT_NEAR(Sliced(geometry::Cone{1, 2}, upside_down, {-5, 0})[0].radius, 0.5, 1e-12);
}

TEST(Slice, OfATiltedBoardIsThePartBetweenTheHeights) {
  // A board is inclined by 45° and passes through the origin. Between z = 0.1 and 0.2 its mid-plane
  // covers x from -0.2 to -0.1, and half its thickness times sqrt 2 more on each side.
  const Pose tilted{{0, 0, 0}, FromAxisAngle({0, 1, 0}, kPi / 4)};
  const auto pieces = Sliced(geometry::Box{{10, 2, 0.02}}, tilted, {0.1, 0.2});
  ASSERT_EQ(pieces.size(), 1u);
  EXPECT_NEAR(ReachX(pieces[0]), -0.1 + 0.01 * std::sqrt(2), 1e-9);
  EXPECT_NEAR(ReachY(pieces[0]), 1, 1e-9);
}

TEST(Slice, OfATiltedCylinderEnclosesItTightly) {
  const Pose tilted{{0, 0, 0}, FromAxisAngle({0, 1, 0}, 0.5)};
  const auto pieces = Sliced(geometry::Cylinder{0.3, 4}, tilted, {-0.1, 0.1});
  ASSERT_EQ(pieces.size(), 1u);
  EXPECT_GE(ReachY(pieces[0]), 0.3);
  EXPECT_LE(ReachY(pieces[0]), 0.3 * 1.02);
  // The section is an ellipse with the half-axis 0.3 / cos 0.5, shifted by tan 0.5 times the
  // height.
  const double expected = 0.3 / std::cos(0.5) + 0.1 * std::tan(0.5);
  EXPECT_GE(ReachX(pieces[0]), expected - 1e-9);
  EXPECT_LE(ReachX(pieces[0]), expected * 1.02);
}

TEST(Slice, OfAMeshIsOnePieceForEachTriangleBetweenTheHeights) {
  auto mesh = std::make_shared<geometry::TriangleMesh>();
  mesh->positions = {{0, 0, 0}, {1, 0, 0}, {0, 0, 2}, {5, 5, 3}, {6, 5, 3}, {5, 6, 3}};
  mesh->triangles = {{0, 1, 2}, {3, 4, 5}};
  const auto pieces = Sliced(geometry::Mesh{mesh, {1, 2, 1}}, {}, {1, 2.5});
  // The part of the upright triangle above z = 1 is from x = 0 to 0.5. The horizontal triangle is
  // too high.
  ASSERT_EQ(pieces.size(), 1u);
  EXPECT_EQ(pieces[0].vertex_count, 2);
  EXPECT_NEAR(ReachX(pieces[0]), 0.5, 1e-12);
}

TEST(Slice, OmitsShapesThatOnlyTouchTheHeights) {
  EXPECT_TRUE(Sliced(geometry::Box{{1, 1, 1}}, {}, {0.5, 2}).empty());
  EXPECT_TRUE(Sliced(geometry::Box{{1, 1, 1}}, {}, {-2, -0.5}).empty());
  EXPECT_EQ(Sliced(geometry::Box{{1, 1, 1}}, {}, {0.49, 2}).size(), 1u);
}

}  // namespace
}  // namespace gsv::dynamics
