// Tests the points at which shapes touch against closed forms.
#include "gsv/dynamics/rigid/placed_piece.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "gsv/geometry/constants.h"

namespace gsv::dynamics {
namespace {

using geometry::Quaternion;
using geometry::Vector3;
using PieceKind = Piece::Kind;

constexpr double kTouchMargin = 1e-3;

Piece PieceOf(PieceKind kind, const Vector3& half) {
  Piece piece;
  piece.kind = kind;
  piece.half = piece.box = half;
  piece.normal = {0, 0, 1};
  return piece;
}

std::vector<TouchPoint> Touch(const Piece& first, const Vector3& at, const Quaternion& turn,
                              const Piece& second, double margin = kTouchMargin) {
  std::vector<TouchPoint> points;
  const bool is_known = AddTouchPoints(Place(first, at, MatrixOf(turn)),
                                       Place(second, {}, MatrixOf(Quaternion{})), margin, points);
  EXPECT_TRUE(is_known);
  return points;
}

const Piece kGroundPlane = PieceOf(PieceKind::kPlane, {});
const Piece kCube = PieceOf(PieceKind::kBox, {0.5, 0.5, 0.5});

TEST(PlacedPiece, BoxStandsOnItsFourCorners) {
  const auto points = Touch(kCube, {1, 2, 0.4}, {}, kGroundPlane);
  ASSERT_EQ(points.size(), 4u);
  for (const TouchPoint& point : points) {
    EXPECT_NEAR(point.distance, -0.1, 1e-12);
    EXPECT_NEAR(std::abs(point.on_second.x - 1), 0.5, 1e-12);
    EXPECT_NEAR(std::abs(point.on_second.y - 2), 0.5, 1e-12);
    EXPECT_NEAR(point.on_second.z, 0, 1e-12);
    EXPECT_EQ(point.normal, (Vector3{0, 0, 1}));
  }
}

TEST(PlacedPiece, SwappingAPairReversesTheNormal) {
  std::vector<TouchPoint> points;
  const auto placed = Place(PieceOf(PieceKind::kSphere, {0.5, 0.5, 0}), {0, 0, 0.4}, {});
  ASSERT_TRUE(AddTouchPoints(Place(kGroundPlane, {}, {}), placed, kTouchMargin, points));
  ASSERT_EQ(points.size(), 1u);
  EXPECT_NEAR(points[0].normal.z, -1, 1e-12);
  EXPECT_NEAR(points[0].distance, -0.1, 1e-12);
  EXPECT_NEAR(points[0].on_second.z, -0.1, 1e-12);  // the lowest point of the sphere
}

TEST(PlacedPiece, WheelTouchesAPlaneAtBothRims) {
  const Piece wheel = PieceOf(PieceKind::kCylinder, {0.1, 0.1, 0.03});
  const auto lying = geometry::FromAxisAngle({1, 0, 0}, geometry::kPi / 2);
  const auto points = Touch(wheel, {0, 0, 0.1}, lying, kGroundPlane);
  ASSERT_EQ(points.size(), 2u);
  for (const TouchPoint& point : points) {
    EXPECT_NEAR(point.distance, 0, 1e-12);
    EXPECT_NEAR(std::abs(point.on_second.y), 0.03, 1e-12);
    EXPECT_NEAR(point.on_second.x, 0, 1e-12);
  }
}

TEST(PlacedPiece, BoxesShareTheAreaOfTheirFaces) {
  // The second box is rotated by 45° about the vertical, so the common area is an octagon.
  const auto turned = geometry::FromAxisAngle({0, 0, 1}, geometry::kPi / 4);
  const auto points = Touch(kCube, {0, 0, 0.99}, turned, kCube);
  ASSERT_EQ(points.size(), 4u);
  for (const TouchPoint& point : points) {
    EXPECT_NEAR(point.distance, -0.01, 1e-9);
    EXPECT_NEAR(point.normal.z, 1, 1e-12);
    EXPECT_LE(std::max(std::abs(point.on_second.x), std::abs(point.on_second.y)), 0.5 + 1e-9);
  }
}

TEST(PlacedPiece, EdgesOfBoxesCrossAtOnePoint) {
  // The lower box stands on an edge along y. The upper box stands on it with an edge along x.
  const double half = std::sqrt(0.5);
  const auto lower = geometry::FromAxisAngle({0, 1, 0}, geometry::kPi / 4);
  const auto upper = geometry::FromAxisAngle({1, 0, 0}, geometry::kPi / 4);
  std::vector<TouchPoint> points;
  ASSERT_TRUE(AddTouchPoints(Place(kCube, {0.1, 0.2, 2 * half - 0.01}, MatrixOf(upper)),
                             Place(kCube, {}, MatrixOf(lower)), kTouchMargin, points));
  ASSERT_EQ(points.size(), 1u);
  EXPECT_NEAR(points[0].distance, -0.01, 1e-9);
  EXPECT_NEAR(points[0].normal.z, 1, 1e-9);
  EXPECT_NEAR(points[0].on_second.x, 0, 1e-9);
  EXPECT_NEAR(points[0].on_second.y, 0.2, 1e-9);
}

TEST(PlacedPiece, SphereLeavesABoxThroughTheNearestFace) {
  const Piece ball = PieceOf(PieceKind::kSphere, {0.1, 0.1, 0});
  const auto inside = Touch(ball, {0.4, 0.1, 0}, {}, kCube);
  ASSERT_EQ(inside.size(), 1u);
  EXPECT_NEAR(inside[0].normal.x, 1, 1e-12);
  EXPECT_NEAR(inside[0].distance, -0.2, 1e-12);
  const auto at_corner = Touch(ball, {0.55, 0.55, 0.55}, {}, kCube);
  ASSERT_EQ(at_corner.size(), 1u);
  EXPECT_NEAR(at_corner[0].distance, std::sqrt(3 * 0.05 * 0.05) - 0.1, 1e-12);
}

TEST(PlacedPiece, PointsBeyondTheMarginAreLeftOut) {
  EXPECT_TRUE(Touch(kCube, {0, 0, 0.502}, {}, kGroundPlane).empty());
  EXPECT_EQ(Touch(kCube, {0, 0, 0.502}, {}, kGroundPlane, 0.01).size(), 4u);
  EXPECT_TRUE(Touch(kCube, {0, 0, 1.002}, {}, kCube).empty());
  EXPECT_EQ(Touch(kCube, {0, 0, 1.002}, {}, kCube, 0.01).size(), 4u);
}

}  // namespace
}  // namespace gsv::dynamics
