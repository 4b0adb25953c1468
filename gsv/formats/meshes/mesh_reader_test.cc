#include "gsv/formats/meshes/mesh_reader.h"

#include <cstring>

#include <gmock/gmock.h>

#include "gsv/base/test_folder.h"

namespace gsv::formats {
namespace {

using geometry::Vector3;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

// Returns a file with the triangle (0,0,0) (1,0,0) (0,0,2) of material "red", in a node with the
// transform `matrix`.
std::string Collada(const std::string& asset, const std::string& colour,
                    const std::string& matrix = "1 0 0 0  0 1 0 0  0 0 1 0  0 0 0 1") {
  return R"(<?xml version="1.0"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset>)" +
         asset + R"(</asset>
<library_effects><effect id="e"><profile_COMMON><technique sid="t"><phong>
<diffuse><color sid="diffuse">)" +
         colour + R"(</color></diffuse>
</phong></technique></profile_COMMON></effect></library_effects>
<library_materials><material id="red"><instance_effect url="#e"/></material></library_materials>
<library_geometries><geometry id="g" name="part"><mesh>
<source id="p"><float_array id="pa" count="9">0 0 0 1 0 0 0 0 2</float_array><technique_common>
<accessor source="#pa" count="3" stride="3"><param name="X" type="float"/>
<param name="Y" type="float"/><param name="Z" type="float"/></accessor></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<triangles count="1" material="m"><input semantic="VERTEX" source="#v" offset="0"/>
<p>0 1 2</p></triangles></mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="s"><node id="n" name="body"><matrix>)" +
         matrix +
         R"(</matrix><instance_geometry url="#g"><bind_material><technique_common>
<instance_material symbol="m" target="#red"/></technique_common></bind_material>
</instance_geometry></node></visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#s"/></scene></COLLADA>)";
}

std::string BinaryStl(std::uint32_t claimed, const std::vector<std::array<float, 9>>& triangles) {
  std::string stl(80, ' ');
  stl.append(reinterpret_cast<const char*>(&claimed), 4);
  for (const auto& corners : triangles) {
    const float normal[3] = {0, 0, 1};
    stl.append(reinterpret_cast<const char*>(normal), sizeof normal);
    stl.append(reinterpret_cast<const char*>(corners.data()), sizeof corners);
    stl.append(2, '\0');
  }
  return stl;
}

class MeshReaderTest : public testing::Test {
 protected:
  base::Result<MeshFile> Read(const std::string& name, const std::string& content,
                              const std::string& submesh = "", bool centred = false) {
    TextureReader textures(limits_);
    return MeshReader(limits_, textures)
        .Read(folder_.Write(name, content), submesh, centred, problems_);
  }
  geometry::Bounds BoundsOf(const base::Result<MeshFile>& mesh) {
    return mesh ? geometry::BoundsOf(*mesh->triangles) : geometry::Bounds{};
  }

  base::testing::TestFolder folder_;
  ReadLimits limits_;
  base::Problems problems_;
};

TEST_F(MeshReaderTest, AppliesTheUnitOfColladaButNotItsAxes) {
  for (const char* up : {"X_UP", "Y_UP", "Z_UP"}) {
    const auto mesh = Read("a.dae", Collada("<unit name='inch' meter='0.0254'/><up_axis>" +
                                                std::string(up) + "</up_axis>",
                                            "1 0 0 1"));
    ASSERT_TRUE(mesh.has_value()) << mesh.error().Sentence();
    const auto bounds = BoundsOf(mesh);
    EXPECT_NEAR(bounds.max.x, 0.0254, 1e-7) << up;
    EXPECT_NEAR(bounds.max.y, 0, 1e-7) << up;
    EXPECT_NEAR(bounds.max.z, 0.0508, 1e-7) << up;
  }
}

TEST_F(MeshReaderTest, AppliesTheNodesOfTheScene) {
  // The triangle is rotated by a quarter turn about z and moved by (10, 0, 0): x becomes y.
  const auto mesh = Read(
      "a.dae", Collada("<unit meter='1'/>", "1 0 0 1", "0 -1 0 10  1 0 0 0  0 0 1 0  0 0 0 1"));
  ASSERT_TRUE(mesh.has_value());
  EXPECT_NEAR(BoundsOf(mesh).min.x, 10, 1e-6);
  EXPECT_NEAR(BoundsOf(mesh).max.y, 1, 1e-6);
  // The face (0,0,0) (1,0,0) (0,0,2) has the normal -y, and after the rotation +x.
  for (const Vector3& normal : mesh->triangles->normals) EXPECT_NEAR(normal.x, 1, 1e-6);
}

TEST_F(MeshReaderTest, ReversesTrianglesOfMirroredNodes) {
  const auto mesh =
      Read("a.dae", Collada("<unit meter='1'/>", "1 0 0 1", "-1 0 0 0  0 1 0 0  0 0 1 0  0 0 0 1"));
  ASSERT_TRUE(mesh.has_value());
  const auto& t = mesh->triangles->triangles.at(0);
  const auto& p = mesh->triangles->positions;
  EXPECT_LT(geometry::Cross(p[t[1]] - p[t[0]], p[t[2]] - p[t[0]]).y, 0);
}

TEST_F(MeshReaderTest, ReadsColoursWithBlanksAroundThem) {
  for (const char* colour : {"0.25 0.5 0.75 1", "  \n\t0.25 0.5 0.75 1  "}) {
    const auto mesh = Read("a.dae", Collada("<unit meter='1'/>", colour));
    ASSERT_TRUE(mesh.has_value()) << mesh.error().Sentence();
    const auto& material = mesh->materials.at(mesh->triangles->parts.at(0).material);
    EXPECT_NEAR(material.base_colour.r, 0.25, 1e-6);
    EXPECT_NEAR(material.base_colour.b, 0.75, 1e-6);
  }
}

TEST_F(MeshReaderTest, ReadsBinaryStlAndDropsTrianglesWithoutArea) {
  const auto mesh = Read("a.stl", BinaryStl(3, {{0, 0, 0, 1, 0, 0, 0, 1, 0},
                                                {0, 0, 0, 1, 0, 0, 2, 0, 0},
                                                {5, 5, 5, 5, 5, 5, 5, 5, 6}}));
  ASSERT_TRUE(mesh.has_value()) << mesh.error().Sentence();
  EXPECT_THAT(mesh->triangles->triangles, SizeIs(1));
}

constexpr char kObj[] =
    "mtllib a.mtl\n"
    "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 4 0 0\nv 6 0 0\nv 4 2 0\nvt 0 0\nvt 1 0\nvt 0 1\n"
    "o left\nusemtl green\nf 1/1 2/2 3/3\no right\nusemtl green\nf 4/1 5/2 6/3\n";

TEST_F(MeshReaderTest, ReadsSubmeshesAndCentresThem) {
  folder_.Write("a.mtl", "newmtl green\nKd 0 1 0\n");
  const auto all = Read("a.obj", kObj);
  ASSERT_TRUE(all.has_value()) << all.error().Sentence();
  EXPECT_THAT(all->triangles->triangles, SizeIs(2));
  EXPECT_THAT(all->triangles->texture_coordinates, SizeIs(all->triangles->positions.size()));
  EXPECT_NEAR(all->materials.at(all->triangles->parts.at(0).material).base_colour.g, 1, 1e-6);

  const auto right = Read("a.obj", kObj, "right");
  ASSERT_TRUE(right.has_value()) << right.error().Sentence();
  EXPECT_NEAR(BoundsOf(right).min.x, 4, 1e-6);
  const auto centred = Read("a.obj", kObj, "right", true);
  EXPECT_NEAR(BoundsOf(centred).min.x, -1, 1e-6);
  EXPECT_NEAR(BoundsOf(centred).max.y, 1, 1e-6);

  const auto absent = Read("a.obj", kObj, "middle");
  ASSERT_FALSE(absent.has_value());
  EXPECT_THAT(absent.error().Sentence(), HasSubstr("no submesh \"middle\""));
}

TEST_F(MeshReaderTest, ReadsNumbersWithoutALeadingZero) {
  const auto mesh = Read("zero.obj", "v 0 0 0\nv .2 0 0\nv 0 -.3\t.4\nf 1 2 3\n");
  ASSERT_TRUE(mesh.has_value()) << mesh.error().Sentence();
  EXPECT_NEAR(BoundsOf(mesh).max.x, 0.2, 1e-6);
  EXPECT_NEAR(BoundsOf(mesh).min.y, -0.3, 1e-6);
  EXPECT_NEAR(BoundsOf(mesh).max.z, 0.4, 1e-6);
}

// assimp's reader did not terminate on a last line without a newline.
TEST_F(MeshReaderTest, ReadsObjWhoseLastLineDoesNotEnd) {
  const auto mesh = Read("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf -1 -2  ");
  ASSERT_TRUE(mesh.has_value()) << mesh.error().Sentence();
  EXPECT_THAT(mesh->triangles->triangles, SizeIs(1));
}

TEST_F(MeshReaderTest, WarnsOfMissingTextures) {
  folder_.Write("a.mtl", "newmtl green\nKd 0 1 0\nmap_Kd nowhere.png\n");
  EXPECT_TRUE(Read("a.obj", kObj).has_value());
  ASSERT_THAT(problems_, SizeIs(1));
  EXPECT_THAT(problems_[0].Sentence(), HasSubstr("nowhere.png"));
  EXPECT_EQ(problems_[0].severity, base::Problem::Severity::kWarning);
}

// A TGA of one red pixel whose alpha is zero.
const std::string kSeeThrough{"\0\0\2\0\0\0\0\0\0\0\0\0\1\0\1\0\x20\x28\0\0\xff\0", 22};

// Gazebo's model of the Create has an image whose alpha is zero nearly everywhere. The robot must
// still be opaque, because its material does not use the alpha.
TEST_F(MeshReaderTest, TheAlphaOfAnImageCountsIfTheMaterialUsesIt) {
  folder_.Write("red.tga", kSeeThrough);
  folder_.Write("a.mtl", "newmtl green\nmap_Kd red.tga\n");
  const auto opaque = Read("a.obj", kObj);
  ASSERT_TRUE(opaque.has_value()) << opaque.error().Sentence();
  const model::Material& solid = opaque->materials.at(opaque->triangles->parts.at(0).material);
  EXPECT_THAT(solid.base_colour_map->pixels, testing::ElementsAre(255, 0, 0));
  EXPECT_FALSE(solid.alpha_mask);

  folder_.Write("a.mtl", "newmtl green\nmap_Kd red.tga\nmap_d red.tga\n");
  const auto cut = Read("a.obj", kObj);
  ASSERT_TRUE(cut.has_value()) << cut.error().Sentence();
  const model::Material& net = cut->materials.at(cut->triangles->parts.at(0).material);
  EXPECT_THAT(net.base_colour_map->pixels, testing::ElementsAre(255, 0, 0, 0));
  EXPECT_TRUE(net.alpha_mask);
}

// Returns a glTF file: a triangle with an image of one red pixel with alpha zero.
std::string Gltf(const std::string& alpha_mode) {
  return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],
"meshes":[{"primitives":[{"attributes":{"POSITION":0,"TEXCOORD_0":1},"material":0}]}],
"materials":[{)" +
         (alpha_mode.empty() ? "" : "\"alphaMode\":\"" + alpha_mode + "\",") +
         R"("pbrMetallicRoughness":{"baseColorTexture":{"index":0}}}],
"textures":[{"source":0}],"images":[{"uri":"data:image/png;base64,)"
         "iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAYAAAAfFcSJAAAADUlEQVR4nGP4z8DAAAAEAQEARwbK3gAAAABJRU5Er"
         "kJg"
         R"(gg=="}],
"buffers":[{"byteLength":60,"uri":"data:application/octet-stream;base64,)"
         "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAAAAAAAAAAAAAAAIA/AAAAAAAAAAAAAIA/"
         R"("}],
"bufferViews":[{"buffer":0,"byteLength":36},{"buffer":0,"byteOffset":36,"byteLength":24}],
"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],
"max":[1,1,0]},{"bufferView":1,"componentType":5126,"count":3,"type":"VEC2"}]})";
}

TEST_F(MeshReaderTest, AppliesTheAlphaModeOfGltf) {
  const struct {
    const char* mode;
    int channels;
    bool cut_out;
  } cases[] = {{"", 3, false}, {"OPAQUE", 3, false}, {"MASK", 4, true}, {"BLEND", 4, false}};
  for (const auto& c : cases) {
    const auto mesh = Read("a.gltf", Gltf(c.mode));
    ASSERT_TRUE(mesh.has_value()) << mesh.error().Sentence();
    const model::Material& material = mesh->materials.at(mesh->triangles->parts.at(0).material);
    ASSERT_NE(material.base_colour_map, nullptr) << c.mode;
    EXPECT_EQ(material.base_colour_map->channels, c.channels) << c.mode;
    EXPECT_EQ(material.alpha_mask, c.cut_out) << c.mode;
  }
}

// Returns the file of Gltf() with further nodes, which have these children.
std::string GltfWithNodes(const std::vector<std::string>& children) {
  std::string nodes;
  for (const std::string& each : children) nodes += ",{\"children\":[" + each + "]}";
  const std::string written = R"("nodes":[{"mesh":0}],)";
  std::string text = Gltf("");
  return text.replace(text.find(written), written.size(), R"("nodes":[{"mesh":0})" + nodes + "],");
}

TEST_F(MeshReaderTest, RejectsNodesThatContainThemselvesOrAreNestedTooDeep) {
  EXPECT_TRUE(Read("two.gltf", GltfWithNodes({"0", "1"})).has_value());
  const auto in_itself = Read("cycle.gltf", GltfWithNodes({"2", "3", "1"}));
  ASSERT_FALSE(in_itself.has_value());
  EXPECT_THAT(in_itself.error().message, HasSubstr("a node contains itself"));
  const auto missing = Read("missing.gltf", GltfWithNodes({"9"}));
  ASSERT_FALSE(missing.has_value());
  EXPECT_THAT(missing.error().message, HasSubstr("a node names a missing child"));
  std::vector<std::string> chain{"0"};
  std::vector<std::string> doubled{"0,0"};
  for (int i = 1; i < 100'000; ++i) chain.push_back(std::to_string(i));
  for (int i = 1; i < 64; ++i) doubled.push_back(std::to_string(i) + "," + std::to_string(i));
  const auto deep = Read("deep.gltf", GltfWithNodes(chain));
  ASSERT_FALSE(deep.has_value());
  EXPECT_THAT(deep.error().message, HasSubstr("its nodes are nested deeper than 512 levels"));
  const auto many = Read("many.gltf", GltfWithNodes(doubled));
  ASSERT_FALSE(many.has_value());
  EXPECT_THAT(many.error().message, HasSubstr("more than 1000000 nodes"));
}

TEST_F(MeshReaderTest, ReadsEachFileOnce) {
  const auto path = folder_.Write("a.stl", BinaryStl(1, {{0, 0, 0, 1, 0, 0, 0, 1, 0}}));
  TextureReader textures(limits_);
  MeshReader reader(limits_, textures);
  const auto first = reader.Read(path, "", false, problems_);
  EXPECT_EQ(reader.Read(path, "", false, problems_)->triangles, first->triangles);
}

TEST_F(MeshReaderTest, ReadsTheTrianglesOfATruncatedStl) {
  const auto mesh = Read("cut.stl", BinaryStl(1'000'000'000, {{0, 0, 0, 1, 0, 0, 0, 1, 0}}));
  ASSERT_TRUE(mesh.has_value()) << mesh.error().Sentence();
  EXPECT_THAT(mesh->triangles->triangles, SizeIs(1));
  ASSERT_THAT(problems_, SizeIs(1));
  EXPECT_THAT(problems_[0].message,
              HasSubstr("declares more triangles than the file contains; 1 of"));
}

std::string Replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

TEST_F(MeshReaderTest, ReadsColladaWithAnErrorThatAssimpRefuses) {
  const std::string sound = Collada("<unit meter='1'/>", "1 0 0 1");
  const std::string animation =
      "<library_animations><animation id='a'><source id='t'><float_array id='ta' count='1'>x"
      "</float_array></source><channel source='#none' target='n/matrix'/></animation>"
      "</library_animations>";
  const std::pair<const char*, std::string> flawed[] = {
      {"comment.dae", Replaced(sound, "<vertices id=\"v\">", "<vertices id='v'><!-- flat -->")},
      {"image.dae", Replaced(sound, "<library_effects>",
                             "<library_images><image id='i'><!-- lost --></image></library_images>"
                             "<library_effects>")},
      {"holes.dae",
       Replaced(Replaced(sound, "<triangles count=\"1\"", "<polygons count=\"1\""),
                "<p>0 1 2</p></triangles>", "<ph><p>0 1 2</p><h>0 1 2</h></ph></polygons>")},
      {"animation.dae",
       Replaced(sound, "<library_geometries>", animation + "<library_geometries>")},
      {"second.dae",
       Replaced(sound, "</geometry></library_geometries>",
                "</geometry><geometry id='h'><mesh><triangles><p>0 one 2</p></triangles></mesh>"
                "</geometry></library_geometries>")}};
  for (const auto& [name, content] : flawed) {
    const auto mesh = Read(name, content);
    ASSERT_TRUE(mesh.has_value()) << name << ": " << mesh.error().Sentence();
    EXPECT_THAT(mesh->triangles->triangles, SizeIs(1)) << name;
  }
}

TEST_F(MeshReaderTest, FindsASubmeshByTheNameOrIdOfItsNodeOrGeometry) {
  const std::string content = Collada("<unit meter='1'/>", "1 0 0 1");
  for (const char* submesh : {"body", "n", "part", "g"}) {
    EXPECT_TRUE(Read("a.dae", content, submesh).has_value()) << submesh;
  }
  EXPECT_FALSE(Read("a.dae", content, "nobody").has_value());
}

TEST_F(MeshReaderTest, RefusesDamagedFilesAndThoseBeyondTheLimits) {
  const struct {
    const char *name, *says;
    std::string content;
  } cases[] = {
      {"none.stl", "", BinaryStl(0, {})},
      {"flat.stl", "no triangles", BinaryStl(1, {{0, 0, 0, 1, 0, 0, 2, 0, 0}})},
      {"cut.dae", "cannot be read", Collada("<unit meter='1'/>", "1 0 0 1").substr(0, 900)},
      {"empty.dae", "cannot be read", ""},
      {"noise.glb", "cannot be read", std::string(100, '\x7f')},
      {"far.obj", "", "v 0 0 0\nf 1 2 99\n"},
      {"more.dae", "declares more values",
       std::string(Collada("<unit meter='1'/>", "1 0 0 1"))
           .replace(Collada("<unit meter='1'/>", "1 0 0 1").find("count=\"9\""), 9,
                    "count=\"4000000000\"")},
      // Found by the fuzzer: assimp read memory behind the array.
      {"beyond.dae", "more values than its array contains",
       std::string(Collada("<unit meter='1'/>", "1 0 0 1"))
           .replace(Collada("<unit meter='1'/>", "1 0 0 1").find("count=\"9\""), 9, "xount=\"9\"")},
      {"odd.dae", "more values than its array contains",
       std::string(Collada("<unit meter='1'/>", "1 0 0 1"))
           .replace(Collada("<unit meter='1'/>", "1 0 0 1").find("count=\"9\""), 9,
                    "count=\"9e0\"")},
      {"junk.dae", "other than whole numbers",
       std::string(Collada("<unit meter='1'/>", "1 0 0 1"))
           .replace(Collada("<unit meter='1'/>", "1 0 0 1").find("<p>0 1 2"), 8, "<p>0 &lt;1 2")},
      {"scene.blend", "only", "BLENDER"},
  };
  for (const auto& [name, says, content] : cases) {
    const auto mesh = Read(name, content);
    ASSERT_FALSE(mesh.has_value()) << name;
    EXPECT_THAT(mesh.error().Sentence(), HasSubstr(says)) << name;
    EXPECT_THAT(mesh.error().Sentence(), HasSubstr(name));
  }
  limits_.mesh_triangles = 1;
  EXPECT_THAT(Read("a.obj", kObj).error().Sentence(), HasSubstr("limit of 1 triangles"));
  limits_.mesh_bytes = 10;
  EXPECT_THAT(Read("b.obj", kObj).error().Sentence(), HasSubstr("limit of 10 bytes"));
}

}  // namespace
}  // namespace gsv::formats
