#include "gsv/formats/gltf/glb_reader.h"

#include <gtest/gtest.h>

#include "gsv/formats/gltf/gltf_writer.h"

namespace gsv::formats {
namespace {

using geometry::Vector3;
using GlbFile = std::vector<std::uint8_t>;

std::shared_ptr<model::Image> Checkers() {
  auto image = std::make_shared<model::Image>();
  image->width = image->height = 2;
  image->channels = 3;
  image->pixels = {255, 0, 0, 0, 255, 0, 0, 0, 255, 255, 255, 255};
  return image;
}

model::Model Cart() {
  model::Model cart;
  cart.name = "cart";
  cart.links.resize(2);
  cart.links[0].name = "base";
  cart.links[0].visuals.resize(2);
  cart.links[0].visuals[0].name = "body";
  cart.links[0].visuals[0].shape = geometry::Box{{1, 2, 3}};
  cart.links[0].visuals[0].materials[0].base_colour = {0.2, 0.4, 0.6, 0.5};
  cart.links[0].visuals[0].materials[0].emissive = {0.1, 0, 0, 1};
  cart.links[0].visuals[0].materials[0].metalness = 0.25;
  cart.links[0].visuals[0].materials[0].double_sided = true;
  cart.links[0].visuals[1].shape = geometry::Plane{{0, 0, 1}, {30, 40}};
  cart.links[0].visuals[1].cast_shadows = false;
  cart.links[1].name = "inner::wheel";
  cart.links[1].model_from_link = {{1, 2, 3}, geometry::FromAxisAngle({0, 0, 1}, 0.5)};
  cart.links[1].visuals.resize(1);
  auto triangle = std::make_shared<geometry::TriangleMesh>();
  triangle->positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  triangle->texture_coordinates = {{0, 0}, {1, 0}, {0, 1}, {0.5, 0.25}};
  triangle->triangles = {{0, 1, 2}, {0, 2, 3}};
  triangle->parts = {{"a", 0, 1, 0}, {"b", 1, 1, 1}};
  cart.links[1].visuals[0].shape = geometry::Mesh{triangle, {1, -2, 3}};
  cart.links[1].visuals[0].materials.resize(2);
  cart.links[1].visuals[0].materials[1].base_colour_map = Checkers();
  return cart;
}

model::Model Reread(const model::Model& model) {
  const auto glb = WriteGlb(model);
  EXPECT_TRUE(glb);
  auto read = ReadGlb(*glb, "cart.glb");
  EXPECT_TRUE(read) << read.error().Sentence();
  return read ? *read : model::Model{};
}

TEST(ReadGlb, ReadsLinksAndVisualsOfTheWriter) {
  const model::Model cart = Reread(Cart());
  ASSERT_EQ(cart.links.size(), 2u);
  EXPECT_EQ(cart.name, "cart");
  EXPECT_EQ(cart.links[0].name, "base");
  EXPECT_EQ(cart.links[1].name, "inner::wheel");
  EXPECT_EQ(cart.links[1].model_from_link.position, (Vector3{1, 2, 3}));
  EXPECT_NEAR(geometry::Yaw(cart.links[1].model_from_link.orientation), 0.5, 1e-9);
  ASSERT_EQ(cart.links[0].visuals.size(), 2u);
  EXPECT_EQ(cart.links[0].visuals[0].name, "body");
  EXPECT_TRUE(cart.links[0].visuals[0].cast_shadows);
  EXPECT_FALSE(cart.links[0].visuals[1].cast_shadows);
  const geometry::Bounds bounds = geometry::BoundsOf(cart.links[0].visuals[0].shape);
  EXPECT_EQ(bounds.max, (Vector3{0.5, 1, 1.5}));
}

TEST(ReadGlb, ReadsMaterials) {
  const model::Material material = Reread(Cart()).links[0].visuals[0].materials.at(0);
  EXPECT_NEAR(material.base_colour.r, 0.2, 1e-6);
  EXPECT_NEAR(material.base_colour.g, 0.4, 1e-6);
  EXPECT_NEAR(material.base_colour.b, 0.6, 1e-6);
  EXPECT_NEAR(material.base_colour.a, 0.5, 1e-6);
  EXPECT_NEAR(material.emissive.r, 0.1, 1e-6);
  EXPECT_DOUBLE_EQ(material.metalness, 0.25);
  EXPECT_TRUE(material.double_sided);
}

TEST(ReadGlb, ReadsOcclusionAndLightMaps) {
  model::Model cart = Cart();
  model::Material& given = cart.links[1].visuals[0].materials[0];
  given.occlusion_map = Checkers();
  given.light_map = Checkers();
  const auto materials = Reread(cart).links[1].visuals.at(0).materials;
  ASSERT_NE(materials.at(0).occlusion_map, nullptr);
  ASSERT_NE(materials[0].light_map, nullptr);
  EXPECT_EQ(materials[0].light_map->width, 2);
  EXPECT_EQ(materials.at(1).light_map, nullptr);
}

TEST(ReadGlb, KeepsPartsScaleAndTextureCoordinates) {
  const model::Visual visual = Reread(Cart()).links[1].visuals.at(0);
  const auto& mesh = std::get<geometry::Mesh>(visual.shape);
  EXPECT_EQ(mesh.scale, (Vector3{1, -2, 3}));
  ASSERT_EQ(mesh.triangles->positions.size(), 4u);  // shared by both parts
  ASSERT_EQ(mesh.triangles->parts.size(), 2u);
  EXPECT_EQ(mesh.triangles->parts[1].first_triangle, 1u);
  EXPECT_EQ(mesh.triangles->triangles[1], (std::array<std::uint32_t, 3>{0, 2, 3}));
  EXPECT_DOUBLE_EQ(mesh.triangles->texture_coordinates[3].y, 0.25);
  ASSERT_EQ(visual.materials.size(), 2u);
  EXPECT_EQ(visual.materials[0].base_colour_map, nullptr);
  ASSERT_NE(visual.materials[1].base_colour_map, nullptr);
  EXPECT_EQ(visual.materials[1].base_colour_map->width, 2);
}

TEST(ReadGlb, ReadsAnUntexturedRectangleAsAPlane) {
  const model::Visual visual = Reread(Cart()).links[0].visuals.at(1);
  const auto* plane = std::get_if<geometry::Plane>(&visual.shape);
  ASSERT_NE(plane, nullptr);
  EXPECT_DOUBLE_EQ(plane->size.x, 30);
  EXPECT_DOUBLE_EQ(plane->size.y, 40);
}

TEST(ReadGlb, RefusesEveryTruncation) {
  const GlbFile glb = *WriteGlb(Cart());
  for (std::size_t size = 0; size < glb.size() - 3; size += 7) {  // up to 3 bytes are padding
    EXPECT_FALSE(ReadGlb({glb.data(), size}, "cart.glb")) << size;
  }
}

TEST(ReadGlb, SurvivesEveryDamagedByte) {
  const GlbFile glb = *WriteGlb(Cart());
  for (std::size_t at = 0; at < glb.size(); ++at) {
    GlbFile damaged = glb;
    damaged[at] = damaged[at] == '9' ? '1' : '9';
    (void)ReadGlb(damaged, "cart.glb");
  }
}

}  // namespace
}  // namespace gsv::formats
