// Tests the written files with assimp's glTF reader, which is independent of GSV.
#include "gsv/formats/gltf/gltf_writer.h"

#include <cmath>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <numbers>

#include <assimp/GltfMaterial.h>
#include <assimp/scene.h>
#include <gtest/gtest.h>
#include <assimp/Importer.hpp>
#include <nlohmann/json.hpp>

#include "gsv/formats/images/web_texture.h"

namespace gsv::formats {
namespace {

using geometry::Box;
using geometry::Pose;
using geometry::Vector3;

using Bytes = std::vector<std::uint8_t>;

Bytes Glb(const model::Model& model) {
  auto glb = WriteGlb(model);
  EXPECT_TRUE(glb) << glb.error().Sentence();
  return glb ? *glb : Bytes{};
}

const aiScene* Read(const Bytes& glb, Assimp::Importer& importer) {
  const aiScene* scene = importer.ReadFileFromMemory(glb.data(), glb.size(), 0, "glb");
  EXPECT_NE(scene, nullptr) << importer.GetErrorString();
  return scene;
}

nlohmann::json JsonOf(const Bytes& glb) {
  std::uint32_t size = 0;
  std::memcpy(&size, glb.data() + 12, 4);
  return nlohmann::json::parse(std::string(glb.begin() + 20, glb.begin() + 20 + size));
}

model::Link LinkWith(const std::string& name, geometry::Shape shape,
                     model::Material material = {}) {
  model::Link link;
  link.name = name;
  link.visuals.resize(1);
  link.visuals[0].name = "visual of " + name;
  link.visuals[0].shape = std::move(shape);
  link.visuals[0].materials = {std::move(material)};
  return link;
}

std::shared_ptr<model::Image> Picture(int width, int height, int channels = 3) {
  auto image = std::make_shared<model::Image>();
  image->width = width, image->height = height, image->channels = channels;
  image->pixels.assign(static_cast<std::size_t>(width) * height * channels, 100);
  return image;
}

model::Model Robot() {
  model::Model robot;
  robot.name = "robot";
  robot.links.push_back(LinkWith("base", Box{{1, 2, 3}}));
  robot.links.push_back(LinkWith("left::wheel", geometry::Cylinder{0.5, 0.2}));
  robot.links.push_back(LinkWith("right::wheel", geometry::Cylinder{0.5, 0.2}));
  robot.links.push_back(model::Link{});
  robot.links[3].name = "frame";
  robot.links[1].model_from_link = {{1, 2, 3},
                                    geometry::FromAxisAngle({0, 0, 1}, std::numbers::pi / 2)};
  robot.links[1].visuals[0].link_from_visual = {{0.5, 0, 0}, {}};
  return robot;
}

// Transforms a point from a node's frame through all its parents.
aiVector3D ToScene(const aiNode* node, aiVector3D point) {
  for (; node != nullptr; node = node->mParent) point = node->mTransformation * point;
  return point;
}

TEST(WriteGlb, HasANodeForEachLinkInOrder) {
  Assimp::Importer importer;
  const aiScene* scene = Read(Glb(Robot()), importer);
  ASSERT_NE(scene, nullptr);
  ASSERT_EQ(scene->mRootNode->mNumChildren, 4u);
  const char* names[] = {"base", "left::wheel", "right::wheel", "frame"};
  for (unsigned i = 0; i < 4; ++i) {
    EXPECT_STREQ(scene->mRootNode->mChildren[i]->mName.C_Str(), names[i]);
  }
}

TEST(WriteGlb, PlacesEveryVisualAtItsLink) {
  Assimp::Importer importer;
  const aiScene* scene = Read(Glb(Robot()), importer);
  ASSERT_NE(scene, nullptr);
  const aiNode* wheel = scene->mRootNode->mChildren[1];
  ASSERT_EQ(wheel->mNumChildren, 1u);
  // The point is half a metre along the link's x axis, which is the model's y axis.
  const aiVector3D at = ToScene(wheel->mChildren[0], {0, 0, 0});
  EXPECT_NEAR(at.x, 1, 1e-6);
  EXPECT_NEAR(at.y, 2.5, 1e-6);
  EXPECT_NEAR(at.z, 3, 1e-6);
}

TEST(WriteGlb, KeepsMetresAndZUp) {
  Assimp::Importer importer;
  const Bytes glb = Glb(Robot());
  const aiScene* scene = Read(glb, importer);
  ASSERT_NE(scene, nullptr);
  const aiNode* box = scene->mRootNode->mChildren[0]->mChildren[0];
  const aiMesh* mesh = scene->mMeshes[box->mMeshes[0]];
  EXPECT_EQ(mesh->mNumFaces, 12u);
  float top = 0;
  for (unsigned i = 0; i < mesh->mNumVertices; ++i) {
    top = std::max(top, ToScene(box, mesh->mVertices[i]).z);
  }
  EXPECT_FLOAT_EQ(top, 1.5f);
  EXPECT_EQ(JsonOf(glb)["asset"]["extras"]["up_axis"], "z");
}

TEST(WriteGlb, TrianglesFaceOutward) {
  Assimp::Importer importer;
  const aiScene* scene = Read(Glb(Robot()), importer);
  ASSERT_NE(scene, nullptr);
  for (unsigned m = 0; m < scene->mNumMeshes; ++m) {
    const aiMesh* mesh = scene->mMeshes[m];
    for (unsigned f = 0; f < mesh->mNumFaces; ++f) {
      const unsigned* i = mesh->mFaces[f].mIndices;
      const aiVector3D face = (mesh->mVertices[i[1]] - mesh->mVertices[i[0]]) ^
                              (mesh->mVertices[i[2]] - mesh->mVertices[i[0]]);
      EXPECT_GT(face * mesh->mNormals[i[0]], 0);
    }
  }
}

TEST(WriteGlb, WritesEqualMeshesAndMaterialsOnce) {
  const nlohmann::json json = JsonOf(Glb(Robot()));
  EXPECT_EQ(json["meshes"].size(), 2u);  // the meshes: a box, and one cylinder for both wheels
  EXPECT_EQ(json["materials"].size(), 1u);
}

TEST(WriteGlb, SharesVerticesBetweenPartsAndTexturesBetweenMaterials) {
  auto mesh = std::make_shared<geometry::TriangleMesh>(geometry::Tessellate(Box{}));
  mesh->parts = {{"a", 0, 4, 0}, {"b", 4, 8, 1}};
  model::Material red, blue;
  red.base_colour_map = blue.base_colour_map = Picture(8, 8);
  red.base_colour = {1, 0, 0, 1};
  model::Model model;
  model.links.push_back(LinkWith("base", geometry::Mesh{mesh, {2, 2, 2}}));
  model.links[0].visuals[0].materials = {red, blue};
  const Bytes glb = Glb(model);
  const nlohmann::json json = JsonOf(glb);
  EXPECT_EQ(json["accessors"].size(), 5u);  // the accessors: positions, normals, uv, and two runs
                                            // of indices
  EXPECT_EQ(json["images"].size(), 1u);
  Assimp::Importer importer;
  const aiScene* scene = Read(glb, importer);
  ASSERT_NE(scene, nullptr);
  ASSERT_EQ(scene->mNumMeshes, 2u);
  EXPECT_EQ(scene->mMeshes[0]->mNumFaces + scene->mMeshes[1]->mNumFaces, 12u);
  EXPECT_EQ(scene->mNumTextures, 1u);
}

TEST(WriteGlb, MaterialsKeepTheirAppearance) {
  model::Material material;
  material.base_colour = {0.5, 1, 0, 0.25};
  material.metalness = 0.75;
  material.roughness = 0.125;
  material.double_sided = true;
  model::Model model;
  model.links.push_back(LinkWith("base", Box{}, material));
  Assimp::Importer importer;
  const aiScene* scene = Read(Glb(model), importer);
  ASSERT_NE(scene, nullptr);
  const aiMaterial& read = *scene->mMaterials[scene->mMeshes[0]->mMaterialIndex];
  aiColor4D base;
  float metallic = 0, roughness = 0;
  bool two_sided = false;
  ASSERT_EQ(read.Get(AI_MATKEY_BASE_COLOR, base), aiReturn_SUCCESS);
  // sRGB 0.5 is 0.2140 in linear light (IEC 61966-2-1).
  EXPECT_NEAR(base.r, 0.21404, 1e-4);
  EXPECT_NEAR(base.g, 1, 1e-6);
  EXPECT_NEAR(base.a, 0.25, 1e-6);
  read.Get(AI_MATKEY_METALLIC_FACTOR, metallic);
  read.Get(AI_MATKEY_ROUGHNESS_FACTOR, roughness);
  read.Get(AI_MATKEY_TWOSIDED, two_sided);
  EXPECT_FLOAT_EQ(metallic, 0.75f);
  EXPECT_FLOAT_EQ(roughness, 0.125f);
  EXPECT_TRUE(two_sided);
  EXPECT_EQ(JsonOf(Glb(model))["materials"][0]["alphaMode"], "BLEND");
}

TEST(WriteGlb, DescribesTheShapesOfVisuals) {
  const nlohmann::json json = JsonOf(Glb(Robot()));
  std::vector<nlohmann::json> shapes;
  for (const auto& node : json["nodes"]) {
    if (node["extras"].contains("shape")) shapes.push_back(node["extras"]["shape"]);
  }
  ASSERT_EQ(shapes.size(), 3u);
  EXPECT_EQ(shapes[0], nlohmann::json::parse(R"({"kind":"box","size":[1.0,2.0,3.0]})"));
  EXPECT_EQ(shapes[1], nlohmann::json::parse(R"({"kind":"cylinder","radius":0.5,"length":0.2})"));
}

TEST(WriteGlb, DeclaresTheExtensionOfALightMap) {
  model::Material material;
  material.occlusion_map = Picture(8, 8);
  material.light_map = Picture(4, 4);
  model::Model model;
  model.links.push_back(LinkWith("base", Box{}, material));
  const nlohmann::json json = JsonOf(Glb(model));
  EXPECT_EQ(json["extensionsUsed"], nlohmann::json::parse(R"(["MOZ_lightmap"])"));
  const auto& written = json["materials"][0];
  EXPECT_NE(written["occlusionTexture"]["index"], written["extensions"]["MOZ_lightmap"]["index"]);
  EXPECT_FALSE(JsonOf(Glb(Robot())).contains("extensionsUsed"));
}

TEST(WriteGlb, EqualModelsGiveEqualBytes) { EXPECT_EQ(Glb(Robot()), Glb(Robot())); }

TEST(WriteGlb, AModelWithoutVisualsIsReadable) {
  model::Model model;
  model.name = "ghost \xff";  // the name is not UTF-8
  model.links.resize(1);
  model.links[0].name = "base";
  const Bytes glb = Glb(model);
  EXPECT_EQ(glb.size() % 4, 0u);
  EXPECT_EQ(JsonOf(glb)["nodes"].size(), 1u);
}

TEST(EncodeForWeb, ScalesLargeImagesDown) {
  const WebTexture texture = EncodeForWeb(*Picture(3000, 100), true);
  EXPECT_EQ(texture.mime_type, "image/jpeg");
  // A JPEG's frame header (T.81, B.2.2): FF C0, length, precision, height, width.
  const auto& b = texture.bytes;
  std::size_t at = 0;
  while (at + 9 < b.size() && !(b[at] == 0xff && b[at + 1] == 0xc0)) ++at;
  ASSERT_LT(at + 9, b.size());
  EXPECT_EQ(b[at + 5] * 256 + b[at + 6], 34);  // 100 / 3000 of 1024 pixels
  EXPECT_EQ(b[at + 7] * 256 + b[at + 8], 1024);
}

TEST(EncodeForWeb, KeepsTransparency) {
  EXPECT_EQ(EncodeForWeb(*Picture(4, 4, 4), true).mime_type, "image/png");
}

TEST(EncodeForWeb, UsesTheOriginalFileUnchanged) {
  const std::filesystem::path path =
      std::filesystem::path(testing::TempDir()) / "encode_for_web_test.png";
  const WebTexture png = EncodeForWeb(*Picture(4, 4, 4), true);
  std::ofstream(path, std::ios::binary)
      .write(reinterpret_cast<const char*>(png.bytes.data()), static_cast<long>(png.bytes.size()));
  auto image = Picture(4, 4, 3);
  image->source = path.string();
  EXPECT_EQ(EncodeForWeb(*image, true).bytes, png.bytes);
  EXPECT_EQ(EncodeForWeb(*image, false).mime_type, "image/jpeg");
  image->width = 2, image->height = 8;  // this is not the size of the image in the file
  EXPECT_EQ(EncodeForWeb(*image, true).mime_type, "image/jpeg");
  std::filesystem::remove(path);
}

TEST(EncodeForWeb, RefusesAnImageWithoutPixels) {
  EXPECT_TRUE(EncodeForWeb(model::Image{}, true).mime_type.empty());
}

}  // namespace
}  // namespace gsv::formats
