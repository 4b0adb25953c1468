#include "gsv/geometry/solid_moments.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace gsv::geometry {
namespace {

using std::numbers::pi;

Mesh MeshOf(const Shape& shape, int segments = 32, Vector3 offset = {}) {
  auto mesh = std::make_shared<TriangleMesh>(Tessellate(shape, segments));
  for (Vector3& position : mesh->positions) position += offset;
  return {mesh, {1, 1, 1}};
}

void ExpectNear(const SolidMoments& a, const SolidMoments& b, double relative) {
  EXPECT_NEAR(a.volume, b.volume, relative * b.volume);
  EXPECT_LT(Norm(a.centroid - b.centroid), relative);
  for (const auto member : {&SolidMoments::xx, &SolidMoments::yy, &SolidMoments::zz,
                            &SolidMoments::xy, &SolidMoments::xz, &SolidMoments::yz}) {
    EXPECT_NEAR(a.*member, b.*member, relative * (b.xx + b.yy + b.zz));
  }
}

TEST(SolidMoments, BoxEqualsTheClosedForm) {
  const SolidMoments moments = MomentsOf(Box{{1, 2, 3}});
  EXPECT_DOUBLE_EQ(moments.volume, 6);
  EXPECT_DOUBLE_EQ(moments.xx, 0.5);
  EXPECT_DOUBLE_EQ(moments.yy, 2);
  EXPECT_DOUBLE_EQ(moments.zz, 4.5);
}

TEST(SolidMoments, BoxMeshEqualsTheBoxAtAnyPosition) {
  SolidMoments expected = MomentsOf(Box{{1, 2, 3}});
  expected.centroid = {100, -20, 7};
  ExpectNear(MomentsOf(MeshOf(Box{{1, 2, 3}}, 3, {100, -20, 7})), expected, 1e-9);
}

TEST(SolidMoments, MirroredMeshEqualsItsMirrorImage) {
  Mesh mesh = MeshOf(Box{{1, 2, 3}}, 3, {1, 0, 0});
  mesh.scale = {-2, 1, 1};
  SolidMoments expected = MomentsOf(Box{{2, 2, 3}});
  expected.centroid = {-2, 0, 0};
  ExpectNear(MomentsOf(mesh), expected, 1e-9);
}

// The moments of fine meshes of round shapes are close to the closed forms.
TEST(SolidMoments, RoundShapesEqualTheirFineMeshes) {
  for (const Shape& shape : {Shape(Sphere{0.7}), Shape(Cylinder{0.5, 2}), Shape(Capsule{0.4, 1}),
                             Shape(Ellipsoid{{0.3, 0.5, 0.8}}), Shape(Cone{0.6, 1.5})}) {
    ExpectNear(MomentsOf(shape), MomentsOf(MeshOf(shape, 256)), 1e-3);
  }
}

TEST(SolidMoments, PlaneHasNoVolume) { EXPECT_EQ(MomentsOf(Plane{}).volume, 0); }

TEST(BelowHeight, CutsABoxAtTheSurface) {
  const Mesh box = MeshOf(Box{{1, 2, 3}});
  const VolumeBelow below = BelowHeight(*box.triangles, {{5, 6, 1}, {}}, 0.25);
  EXPECT_NEAR(below.volume, 1 * 2 * 0.75, 1e-12);
  EXPECT_NEAR(below.first_moment.x / below.volume, 5, 1e-12);
  EXPECT_NEAR(below.first_moment.y / below.volume, 6, 1e-12);
  EXPECT_NEAR(below.first_moment.z / below.volume, (-0.5 + 0.25) / 2, 1e-12);
}

// A cube of edge 1 is rotated by 45° about x. The part below its centre is a triangle whose height
// is half the diagonal.
TEST(BelowHeight, CutsATurnedCubeAtTheSurface) {
  const Mesh cube = MeshOf(Box{{1, 1, 1}});
  const Pose turned{{}, FromAxisAngle({1, 0, 0}, pi / 4)};
  const VolumeBelow below = BelowHeight(*cube.triangles, turned, 0);
  EXPECT_NEAR(below.volume, 0.5, 1e-12);
  EXPECT_NEAR(below.first_moment.z / below.volume, -std::sqrt(0.5) / 3, 1e-12);
}

TEST(BelowHeight, IsEmptyAboveTheSurfaceAndCompleteBelow) {
  const Mesh box = MeshOf(Box{{1, 2, 3}});
  EXPECT_EQ(BelowHeight(*box.triangles, {{0, 0, 10}, {}}, 0).volume, 0);
  EXPECT_NEAR(BelowHeight(*box.triangles, {{0, 0, -10}, {}}, 0).volume, 6, 1e-12);
}

TEST(SphereBelowHeight, IsHalfTheSphereAtItsCentre) {
  const VolumeBelow half = SphereBelowHeight(2, {1, 2, 3}, 3);
  EXPECT_NEAR(half.volume, 2 * pi / 3 * 8, 1e-12);
  EXPECT_NEAR(half.first_moment.z / half.volume, 3 - 3.0 / 8 * 2, 1e-12);
}

TEST(SphereBelowHeight, IsEmptyAboveTheSurfaceAndCompleteBelow) {
  EXPECT_EQ(SphereBelowHeight(1, {0, 0, 2}, 0).volume, 0);
  EXPECT_NEAR(SphereBelowHeight(1, {0, 0, -2}, 0).volume, 4 * pi / 3, 1e-12);
}

}  // namespace
}  // namespace gsv::geometry
