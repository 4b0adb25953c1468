#include "gsv/formats/meshes/polyline.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "gsv/formats/meshes/polygon_triangulation.h"

namespace gsv::formats {
namespace {

using geometry::Vector2;
using geometry::Vector3;

// Returns the volume by the divergence theorem. The result is correct only if the surface is closed
// and faces outwards.
double Volume(const geometry::TriangleMesh& mesh) {
  double six_volumes = 0;
  for (const auto& t : mesh.triangles) {
    six_volumes += geometry::Dot(mesh.positions[t[0]],
                                 geometry::Cross(mesh.positions[t[1]], mesh.positions[t[2]]));
  }
  return six_volumes / 6;
}

Outline Square(double x, double y, double side) {
  return {{x, y}, {x + side, y}, {x + side, y + side}, {x, y + side}};
}

TEST(ExtrudeOutlines, AcceptsClockwiseAndCounterClockwiseOutlines) {
  Outline square = Square(0, 0, 1);
  EXPECT_NEAR(Volume(ExtrudeOutlines({square}, 1.5).value()), 1.5, 1e-12);
  std::reverse(square.begin(), square.end());
  EXPECT_NEAR(Volume(ExtrudeOutlines({square}, 1.5).value()), 1.5, 1e-12);
}

TEST(ExtrudeOutlines, KeepsConcaveOutlines) {
  // The outline is a square of side 1, from whose right side a triangle of base 1 and height 0.5 is
  // cut.
  const Outline arrow = {{-0.5, -0.5}, {-0.5, 0.5}, {0.5, 0.5}, {0, 0}, {0.5, -0.5}};
  EXPECT_NEAR(Volume(ExtrudeOutlines({arrow}, 1).value()), 0.75, 1e-12);
}

TEST(ExtrudeOutlines, MakesHolesAndIslandsByTheEvenOddRule) {
  const double expected = (10 * 10 - 6 * 6 + 2 * 2) * 2.0;
  EXPECT_NEAR(
      Volume(ExtrudeOutlines({Square(4, 4, 2), Square(0, 0, 10), Square(2, 2, 6)}, 2).value()),
      expected, 1e-9);
}

TEST(ExtrudeOutlines, CutsManyHoles) {
  std::vector<Outline> outlines = {Square(0, 0, 10)};
  for (int x = 0; x < 4; ++x) {
    for (int y = 0; y < 4; ++y) outlines.push_back(Square(0.5 + 2.4 * x, 0.5 + 2.4 * y, 1));
  }
  EXPECT_NEAR(Volume(ExtrudeOutlines(outlines, 1).value()), 84, 1e-9);
}

TEST(ExtrudeOutlines, KeepsTheAreaOfARing) {
  const auto circle = [](double radius, int points) {
    Outline outline;
    for (int i = 0; i < points; ++i) {
      const double angle = 2 * std::numbers::pi * i / points;
      outline.push_back({radius * std::cos(angle), radius * std::sin(angle)});
    }
    return outline;
  };
  // The area of a regular n-gon: n/2 r² sin(2 pi / n).
  const double unit = 60 / 2.0 * std::sin(2 * std::numbers::pi / 60);
  EXPECT_NEAR(Volume(ExtrudeOutlines({circle(2, 60), circle(1, 60)}, 1).value()), 3 * unit, 1e-9);
}

TEST(ExtrudeOutlines, RefusesOutlinesWithoutArea) {
  EXPECT_FALSE(ExtrudeOutlines({}, 1).has_value());
  EXPECT_FALSE(ExtrudeOutlines({{{0, 0}, {1, 0}}}, 1).has_value());
  EXPECT_FALSE(ExtrudeOutlines({{{0, 0}, {1, 0}, {2, 0}}}, 1).has_value());
  EXPECT_FALSE(ExtrudeOutlines({Square(0, 0, 1)}, 0).has_value());
  EXPECT_FALSE(ExtrudeOutlines({Square(0, 0, 1)}, NAN).has_value());
  EXPECT_FALSE(ExtrudeOutlines({{{0, 0}, {INFINITY, 0}, {2, 1}}}, 1).has_value());
}

TEST(ExtrudeOutlines, TerminatesOnSelfIntersectingOutlines) {
  // The outline is a bow tie whose halves differ in size. A mesh and an error are both acceptable,
  // but the call must return.
  const auto mesh = ExtrudeOutlines({{{0, 0}, {2, 2}, {2, 0}, {0, 3}}}, 1);
  EXPECT_TRUE(!mesh.has_value() || !mesh->triangles.empty());
}

}  // namespace
}  // namespace gsv::formats
