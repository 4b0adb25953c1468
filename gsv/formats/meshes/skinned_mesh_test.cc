#include "gsv/formats/meshes/skinned_mesh.h"

#include <numbers>

#include <gtest/gtest.h>

#include "gsv/base/test_folder.h"
#include "gsv/formats/testing/bending_dae.h"

namespace gsv::formats {
namespace {

using geometry::Vector3;

class SkinnedMeshTest : public ::testing::Test {
 protected:
  base::Result<SkinnedMesh> Read(const std::string& text, double scale = 1) {
    const auto file = folder_.Write("skin.dae", text);
    return ReadSkinnedMesh(file, file, scale, limits_, textures_, problems_);
  }

  base::testing::TestFolder folder_;
  ReadLimits limits_;
  TextureReader textures_{limits_};
  base::Problems problems_;
};

TEST_F(SkinnedMeshTest, GivesEachBoneItsTriangles) {
  const auto mesh = Read(kBendingDae);
  ASSERT_TRUE(mesh) << mesh.error().Sentence();
  ASSERT_EQ(mesh->bones.size(), 2u);
  EXPECT_EQ(mesh->bones[0].name, "A");
  EXPECT_EQ(mesh->bones[1].name, "B");
  const Vector3 corners[]{{0, 0, 0}, {2, 0, 0}};  // The corners are in the bones' own frames.
  for (int bone = 0; bone < 2; ++bone) {
    const geometry::TriangleMesh& triangles = *mesh->bones[bone].triangles;
    EXPECT_EQ(triangles.triangles.size(), 1u);
    const geometry::Bounds bounds = geometry::BoundsOf(triangles);
    EXPECT_NEAR(Norm(bounds.min - corners[bone]), 0, 1e-6);
    EXPECT_NEAR(Norm(bounds.max - corners[bone] - Vector3{1, 0, 1}), 0, 1e-6);
  }
}

TEST_F(SkinnedMeshTest, RotatesBonesByTheAnimation) {
  const auto mesh = Read(kBendingDae);
  ASSERT_TRUE(mesh) << mesh.error().Sentence();
  EXPECT_NEAR(mesh->length, 1, 1e-6);
  ASSERT_EQ(mesh->root.size(), 30u);
  for (int frame = 0; frame < 30; ++frame) {
    const double angle = std::numbers::pi / 2 * frame / 30;
    const Vector3 tip = mesh->bones[1].skin_from_bone[frame] * Vector3{0, 0, 1};
    EXPECT_NEAR(Norm(tip - Vector3{0, -std::sin(angle), 1 + std::cos(angle)}), 0, 1e-5);
    EXPECT_EQ(mesh->bones[0].skin_from_bone[frame], mesh->bones[0].skin_from_bone[0]);
  }
}

TEST_F(SkinnedMeshTest, ScalesLengths) {
  const auto mesh = Read(kBendingDae, 0.5);
  ASSERT_TRUE(mesh) << mesh.error().Sentence();
  EXPECT_NEAR(mesh->bones[1].skin_from_bone[0].position.z, 0.5, 1e-6);
  EXPECT_NEAR(geometry::BoundsOf(*mesh->bones[1].triangles).max.z, 0.5, 1e-6);
}

TEST_F(SkinnedMeshTest, RefusesAFileWithoutAnimation) {
  std::string text = kBendingDae;
  const auto begin = text.find("<library_animations>"), end = text.find("<library_visual_scenes>");
  text.erase(begin, end - begin);
  const auto mesh = Read(text);
  ASSERT_FALSE(mesh);
  EXPECT_EQ(mesh.error().code, base::ErrorCode::kNotFound);
}

}  // namespace
}  // namespace gsv::formats
