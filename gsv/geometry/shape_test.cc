#include "gsv/geometry/shape.h"

#include <cmath>
#include <map>
#include <set>
#include <tuple>

#include <gtest/gtest.h>

#include "gsv/geometry/box_corners.h"
#include "gsv/geometry/constants.h"

namespace gsv::geometry {
namespace {

using Triangle = std::array<std::uint32_t, 3>;

Vector3 FaceNormal(const TriangleMesh& mesh, const Triangle& t) {
  return Cross(mesh.positions[t[1]] - mesh.positions[t[0]],
               mesh.positions[t[2]] - mesh.positions[t[0]]);
}

double Area(const TriangleMesh& mesh) {
  double area = 0;
  for (const Triangle& t : mesh.triangles) area += 0.5 * Norm(FaceNormal(mesh, t));
  return area;
}

// Returns the volume inside the triangles (divergence theorem); negative if they face inwards.
double Volume(const TriangleMesh& mesh) {
  double volume = 0;
  for (const Triangle& t : mesh.triangles) {
    volume += Dot(mesh.positions[t[0]], Cross(mesh.positions[t[1]], mesh.positions[t[2]])) / 6;
  }
  return volume;
}

// Returns vertices - edges + faces of the surface, where vertices at the same place count as one.
// Also checks that every edge occurs once in each direction: the surface is closed and consistently
// oriented.
int EulerCharacteristic(const TriangleMesh& mesh) {
  using Place = std::tuple<long, long, long>;
  std::map<Place, int> vertex_at;
  const auto vertex = [&](std::uint32_t i) {
    const Vector3& p = mesh.positions[i];
    const Place place{std::lround(p.x * 1e7), std::lround(p.y * 1e7), std::lround(p.z * 1e7)};
    return vertex_at.try_emplace(place, static_cast<int>(vertex_at.size())).first->second;
  };
  std::set<std::pair<int, int>> directed;
  for (const Triangle& t : mesh.triangles) {
    for (int i = 0; i < 3; ++i) {
      const std::pair<int, int> edge{vertex(t[i]), vertex(t[(i + 1) % 3])};
      EXPECT_NE(edge.first, edge.second) << "degenerate triangle";
      EXPECT_TRUE(directed.insert(edge).second) << "edge walked twice";
    }
  }
  for (const auto& [a, b] : directed) EXPECT_TRUE(directed.contains({b, a})) << "open edge";
  return static_cast<int>(vertex_at.size()) - static_cast<int>(directed.size()) / 2 +
         static_cast<int>(mesh.triangles.size());
}

struct Solid {
  const char* name;
  Shape shape;
  double area, volume;
};

std::vector<Solid> Solids() {
  // Knud Thomsen's formula for an ellipsoid's area is approximate. For an oblate spheroid the exact
  // area is known. Here a = 1, c = 0.5, e² = 1 - c²/a².
  const double e = std::sqrt(0.75);
  const double spheroid = 2 * kPi * (1 + 0.25 / e * std::atanh(e));
  std::vector<Solid> solids;
  solids.push_back({"box", Box{{1, 2, 3}}, 22, 6});
  solids.push_back({"sphere", Sphere{0.5}, kPi, kPi / 6});
  solids.push_back(
      {"cylinder", Cylinder{0.5, 2}, 2 * kPi * 0.5 * 2 + 2 * kPi * 0.25, kPi * 0.25 * 2});
  solids.push_back({"capsule", Capsule{0.5, 2}, 2 * kPi * 0.5 * 2 + kPi, kPi * 0.25 * 2 + kPi / 6});
  solids.push_back({"ellipsoid", Ellipsoid{{1, 1, 0.5}}, spheroid, 4.0 / 3 * kPi * 0.5});
  solids.push_back({"cone", Cone{0.6, 0.8}, kPi * 0.36 + kPi * 0.6 * 1.0, kPi * 0.36 * 0.8 / 3});
  return solids;
}

TEST(Tessellate, SolidsAreClosedAndWoundOutward) {
  for (const Solid& solid : Solids()) {
    for (const int segments : {3, 4, 17, 32}) {
      SCOPED_TRACE(std::string(solid.name) + " of " + std::to_string(segments));
      const TriangleMesh mesh = Tessellate(solid.shape, segments);
      EXPECT_EQ(EulerCharacteristic(mesh), 2);
      EXPECT_GT(Volume(mesh), 0);
    }
  }
}

TEST(Tessellate, AreaAndVolumeConvergeQuadratically) {
  for (const Solid& solid : Solids()) {
    SCOPED_TRACE(solid.name);
    for (const int segments : {32, 128}) {
      const double tolerance = 2 * kPi * kPi / (segments * segments);
      const TriangleMesh mesh = Tessellate(solid.shape, segments);
      EXPECT_NEAR(Area(mesh) / solid.area, 1, tolerance);
      EXPECT_NEAR(Volume(mesh) / solid.volume, 1, tolerance);
    }
  }
}

TEST(Tessellate, NormalsHaveUnitLengthAndAgreeWithTheirTriangles) {
  for (const Solid& solid : Solids()) {
    SCOPED_TRACE(solid.name);
    const TriangleMesh mesh = Tessellate(solid.shape, 32);
    ASSERT_EQ(mesh.normals.size(), mesh.positions.size());
    for (const Vector3& n : mesh.normals) EXPECT_NEAR(Norm(n), 1, 1e-9);
    for (const Triangle& t : mesh.triangles) {
      for (const std::uint32_t i : t) {
        EXPECT_GT(Dot(Normalized(FaceNormal(mesh, t)), mesh.normals[i]), 0.9);
      }
    }
  }
}

TEST(Tessellate, TrianglesOfASphereStayWithinTheStatedDistance) {
  const double radius = 2;
  for (const int segments : {8, 32}) {
    const TriangleMesh mesh = Tessellate(Sphere{radius}, segments);
    const double allowed = 2 * radius * (1 - std::cos(kPi / segments));
    for (const Vector3& p : mesh.positions) EXPECT_NEAR(Norm(p), radius, 1e-12);
    for (const Triangle& t : mesh.triangles) {
      // The distance from the centre to the triangle's plane.
      const double depth = Dot(Normalized(FaceNormal(mesh, t)), mesh.positions[t[0]]);
      EXPECT_GE(depth, radius - allowed);
    }
  }
}

TEST(Tessellate, PartsCoverAllTriangles) {
  for (const Solid& solid : Solids()) {
    const TriangleMesh mesh = Tessellate(solid.shape);
    ASSERT_EQ(mesh.parts.size(), 1u);
    EXPECT_EQ(mesh.parts[0].triangle_count, mesh.triangles.size());
  }
}

TEST(Tessellate, EveryFaceOfABoxShowsTheWholeTextureUpright) {
  const TriangleMesh box = Tessellate(Box{{2, 2, 2}});
  ASSERT_EQ(box.positions.size(), 24u);
  // On the face towards +x, seen from outside with z up, +y is to the right.
  for (std::size_t i = 0; i < box.positions.size(); ++i) {
    if (box.normals[i].x < 0.5) continue;
    EXPECT_EQ(box.texture_coordinates[i].x, box.positions[i].y > 0 ? 1 : 0);
    EXPECT_EQ(box.texture_coordinates[i].y, box.positions[i].z > 0 ? 1 : 0);
  }
}

TEST(Tessellate, PlaneIsARectangleThatFacesItsNormal) {
  for (const Vector3& normal :
       {Vector3{0, 0, 1}, Vector3{0, 0, -1}, Vector3{1, 0, 0}, Vector3{0.6, 0, -0.8}}) {
    const TriangleMesh mesh = Tessellate(Plane{normal, {2, 3}});
    EXPECT_NEAR(Area(mesh), 6, 1e-12);
    for (const Triangle& t : mesh.triangles) {
      EXPECT_NEAR(Dot(Normalized(FaceNormal(mesh, t)), normal), 1, 1e-12);
    }
  }
  EXPECT_NEAR(BoundsOf(Shape(Plane{{0, 0, 1}, {2, 3}})).max.y, 1.5, 1e-12);
  EXPECT_NEAR(BoundsOf(Shape(Plane{{1, 0, 0}, {2, 3}})).max.z, 1, 1e-12);
}

TEST(Tessellate, MirroredMeshFacesOutward) {
  const auto box = std::make_shared<const TriangleMesh>(Tessellate(Box{{1, 1, 1}}));
  const TriangleMesh mirrored = Tessellate(Mesh{box, {-2, 3, 1}});
  EXPECT_NEAR(Volume(mirrored), 6, 1e-12);
  for (const Triangle& t : mirrored.triangles) {
    EXPECT_NEAR(Dot(Normalized(FaceNormal(mirrored, t)), mirrored.normals[t[0]]), 1, 1e-12);
  }
}

TEST(Tessellate, NormalsOfAStretchedMeshStayPerpendicular) {
  const auto ball = std::make_shared<const TriangleMesh>(Tessellate(Sphere{1}, 64));
  const TriangleMesh stretched = Tessellate(Mesh{ball, {1, 1, 0.5}});
  const TriangleMesh ellipsoid = Tessellate(Ellipsoid{{1, 1, 0.5}}, 64);
  for (std::size_t i = 0; i < stretched.normals.size(); ++i) {
    EXPECT_NEAR(Dot(stretched.normals[i], ellipsoid.normals[i]), 1, 1e-12);
  }
}

TEST(BoundsOf, EnclosesTheTessellationTightly) {
  for (const Solid& solid : Solids()) {
    SCOPED_TRACE(solid.name);
    // If the number of segments is a multiple of four, the extreme points along every axis are
    // vertices.
    const Bounds true_bounds = BoundsOf(solid.shape);
    const Bounds drawn = BoundsOf(Tessellate(solid.shape, 32));
    EXPECT_NEAR(Norm(true_bounds.min - drawn.min), 0, 1e-12);
    EXPECT_NEAR(Norm(true_bounds.max - drawn.max), 0, 1e-12);
  }
}

TEST(BoundsOf, HaveMinBelowMaxForAMirroredMesh) {
  auto triangles = std::make_shared<TriangleMesh>();
  triangles->positions = {{0, 0, 0}, {1, 2, 3}};
  const Bounds bounds = BoundsOf(Shape(Mesh{triangles, {-1, 1, 2}}));
  EXPECT_EQ(bounds.min, (Vector3{-1, 0, 0}));
  EXPECT_EQ(bounds.max, (Vector3{0, 2, 6}));
}

TEST(CornersOf, ReturnsAllEightCorners) {
  const Bounds box{{1, 2, 3}, {4, 5, 6}};
  std::set<std::tuple<double, double, double>> expected, found;
  for (const double x : {1, 4}) {
    for (const double y : {2, 5}) {
      for (const double z : {3, 6}) expected.emplace(x, y, z);
    }
  }
  for (const Vector3& corner : CornersOf(box)) found.emplace(corner.x, corner.y, corner.z);
  EXPECT_EQ(found, expected);
}

}  // namespace
}  // namespace gsv::geometry
