// Tests that the readers survive malicious and damaged files, and report each with a sentence.
#include <cmath>

#include <gmock/gmock.h>

#include "gsv/base/test_folder.h"
#include "gsv/formats/meshes/mesh_reader.h"
#include "gsv/formats/sdf_reader.h"

namespace gsv::formats {
namespace {

using testing::Contains;
using testing::HasSubstr;

class HostileInputTest : public testing::Test {
 protected:
  // Returns the problems of a model's file, whether it can be read or not.
  std::vector<std::string> ProblemsOf(const std::string& name, const std::string& text) {
    base::Problems problems;
    const auto model = ModelLibrary().ReadModel(folder_.Write(name, text).string(), problems);
    std::vector<std::string> said;
    for (const base::Problem& problem : problems) said.push_back(problem.Sentence());
    if (!model) said.push_back(model.error().Sentence());
    model_ = model ? *model : nullptr;
    return said;
  }
  std::vector<std::string> ProblemsOfModel(const std::string& content) {
    return ProblemsOf("m.sdf",
                      "<sdf version='1.9'>\n<model name='m'>\n" + content + "</model></sdf>");
  }
  base::Result<MeshFile> Mesh(const std::string& name, const std::string& content) {
    base::Problems problems;
    const ReadLimits limits;
    TextureReader textures(limits);
    return MeshReader(limits, textures).Read(folder_.Write(name, content), "", false, problems);
  }

  base::testing::TestFolder folder_;
  std::shared_ptr<const model::Model> model_;
};

// Each of ten entities expands to ten copies of the previous entity.
TEST_F(HostileInputTest, EntitiesOfManyBytesAreRefused) {
  std::string text =
      "<?xml version='1.0'?><!DOCTYPE sdf [<!ENTITY a0 '" + std::string(1000, 'h') + "'>";
  for (int i = 1; i < 10; ++i) {
    text += "<!ENTITY a" + std::to_string(i) + " '";
    for (int k = 0; k < 10; ++k) text += "&a" + std::to_string(i - 1) + ";";
    text += "'>";
  }
  text += "]><sdf version='1.9'><model name='&a9;'><link name='l'/></model></sdf>";
  EXPECT_THAT(ProblemsOf("m.sdf", text),
              Contains(HasSubstr("the entities of the file expand to more than the limit")));
  EXPECT_EQ(model_, nullptr);
}

// assimp would not terminate on the first of these meshes, and would copy 10^12 nodes of the second
// mesh.
TEST_F(HostileInputTest, ColladaNodesThatContainThemselvesAreRefused) {
  const auto scene = [](const std::string& nodes) {
    return "<?xml version='1.0'?><COLLADA version='1.4.1'><library_nodes>" + nodes +
           "</library_nodes><library_visual_scenes><visual_scene id='s'><node><instance_node "
           "url='#n0'/></node>"
           "</visual_scene></library_visual_scenes><scene><instance_visual_scene "
           "url='#s'/></scene></COLLADA>";
  };
  const auto round =
      Mesh("round.dae", scene("<node id='n0'><node id='x'><instance_node url='#n1'/></node></node>"
                              "<node id='n1'><instance_node url='#x'/></node>"));
  ASSERT_FALSE(round);
  EXPECT_THAT(round.error().Sentence(), HasSubstr("one of its nodes contains itself"));
  std::string nodes;
  for (int i = 0; i < 12; ++i) {
    nodes += "<node id='n" + std::to_string(i) + "'>";
    for (int k = 0; k < 10; ++k) nodes += "<instance_node url='#n" + std::to_string(i + 1) + "'/>";
    nodes += "</node>";
  }
  const auto many = Mesh("many.dae", scene(nodes));
  ASSERT_FALSE(many);
  EXPECT_THAT(many.error().Sentence(), HasSubstr("more than 1000000 nodes"));
}

TEST_F(HostileInputTest, NonFiniteValuesAreReportedWithTheirPlace) {
  for (const char* content :
       {"<link name='l'><inertial><mass>nan</mass></inertial></link>",
        "<link name='l'><inertial><mass>inf</mass></inertial></link>",
        "<link name='l'><pose>nan 0 0 0 0 0</pose></link>",
        "<link name='l'><pose>0 0 0 inf 0 0</pose></link>",
        "<link name='l'><collision name='c'><geometry><box><size>inf 1 1</size></box></geometry>"
        "</collision></link>",
        "<link name='l'><collision name='c'><geometry><sphere><radius>nan</radius></sphere>"
        "</geometry></collision></link>",
        "<link name='a'/><link name='b'/><joint name='j' type='revolute'><parent>a</parent>"
        "<child>b</child><axis><xyz>nan 0 0</xyz></axis></joint>",
        "<link name='a'/><link name='b'/><joint name='j' type='revolute'><parent>a</parent>"
        "<child>b</child><axis><xyz>0 0 1</xyz><limit><lower>nan</lower></limit></axis></joint>"}) {
    EXPECT_THAT(ProblemsOfModel(content), Contains(HasSubstr("m.sdf:"))) << content;
    if (model_ == nullptr) continue;
    for (const model::Link& link : model_->links) {
      EXPECT_TRUE(std::isfinite(link.inertial.mass)) << content;
      EXPECT_TRUE(geometry::IsFinite(link.model_from_link)) << content;
    }
  }
}

TEST_F(HostileInputTest, TruncatedUrdfIsRejected) {
  const std::string urdf =
      "<robot name='r'>\n<link name='a'><inertial><mass value='1'/></inertial></link>\n</robot>";
  for (const std::size_t length : {std::size_t{20}, urdf.size() / 2, urdf.size() - 3}) {
    EXPECT_THAT(ProblemsOf("r.urdf", urdf.substr(0, length)), Contains(HasSubstr("malformed")));
  }
}

std::string Gltf(const std::string& index_bytes, int byte_length) {
  // The buffer contains three corners as floats, and then three indices.
  return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],)"
         R"("meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}],"accessors":[)"
         R"({"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"},)"
         R"({"bufferView":1,"componentType":5121,"count":3,"type":"SCALAR"}],"bufferViews":[)"
         R"({"buffer":0,"byteOffset":0,"byteLength":36},{"buffer":0,"byteOffset":36,"byteLength":3}],)"
         R"("buffers":[{"byteLength":)" +
         std::to_string(byte_length) +
         R"(,"uri":"data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA)" +
         index_bytes + "\"}]}";
}

TEST_F(HostileInputTest, GltfWithOutOfRangeIndicesOrBuffersIsRejected) {
  EXPECT_TRUE(Mesh("good.gltf", Gltf("AAEC", 39)).has_value());    // the indices 0, 1, 2
  EXPECT_FALSE(Mesh("index.gltf", Gltf("AAH/", 39)).has_value());  // the indices 0, 1, 255
  EXPECT_FALSE(Mesh("short.gltf", Gltf("", 39)).has_value());
  EXPECT_FALSE(Mesh("huge.gltf", Gltf("AAEC", 2'000'000'000)).has_value());
}

std::string Word(std::uint32_t value) {
  return {reinterpret_cast<const char*>(&value), sizeof value};
}

// Returns a .glb file of `json` and `data`. Its two chunks declare `more_json` and `more_data`
// bytes more than they have.
std::string Glb(std::string json, const std::string& data, std::uint32_t more_json = 0,
                std::uint32_t more_data = 0) {
  json.resize((json.size() + 3) / 4 * 4, ' ');
  const auto length = [](std::size_t bytes) { return static_cast<std::uint32_t>(bytes); };
  const std::string chunks = Word(length(json.size()) + more_json) + "JSON" + json +
                             Word(length(data.size()) + more_data) + std::string("BIN\0", 4) + data;
  return "glTF" + Word(2) + Word(length(12 + chunks.size())) + chunks;
}

std::string TriangleJson(const std::string& accessor_more = "", const std::string& extras = "{}") {
  return R"({"asset":{"version":"2.0"},"extras":{"count":-1},"scene":0,"scenes":[{"nodes":[0]}],)"
         R"("nodes":[{"mesh":0}],"meshes":[{"primitives":[{"attributes":{"POSITION":0}}],"extras":)" +
         extras +
         R"(}],"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3")" +
         accessor_more +
         R"(}],"bufferViews":[{"buffer":0,"byteLength":36}],)"
         R"("buffers":[{"byteLength":36}]})";
}

std::string TriangleData() {
  const float corners[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  return {reinterpret_cast<const char*>(corners), sizeof corners};
}

// Found by the fuzzer: assimp allocated 3 GB for a file of 700 bytes.
TEST_F(HostileInputTest, GlbWithChunksBeyondItsEndIsRejected) {
  const auto good = Mesh("good.glb", Glb(TriangleJson(), TriangleData()));
  ASSERT_TRUE(good.has_value()) << good.error().Sentence();
  EXPECT_EQ(good->triangles->triangles.size(), 1u);
  for (const auto& [more_json, more_data] : {std::pair{2'990'000'000u, 0u}, {0u, 2'990'000'000u}}) {
    const auto mesh = Mesh("long.glb", Glb(TriangleJson(), TriangleData(), more_json, more_data));
    ASSERT_FALSE(mesh.has_value());
    EXPECT_THAT(mesh.error().message, HasSubstr("declares more bytes than the file contains"));
  }
  for (const std::size_t length : {std::size_t{0}, std::size_t{12}, std::size_t{19}}) {
    EXPECT_FALSE(
        Mesh("cut.glb", Glb(TriangleJson(), TriangleData()).substr(0, length)).has_value());
  }
}

TEST_F(HostileInputTest, GltfThatDeclaresMoreThanTheLimitsIsRejected) {
  for (const char* claim :
       {R"(,"sparse":{"count":1000000000000})", R"(,"byteOffset":-1)", R"(,"byteOffset":1e300)",
        R"(,"sparse":{"count":1,"indices":{"byteOffset":99999999999999}})"}) {
    const auto mesh = Mesh("claim.glb", Glb(TriangleJson(claim), TriangleData()));
    ASSERT_FALSE(mesh.has_value()) << claim;
    EXPECT_THAT(mesh.error().message, HasSubstr("more bytes or values than the limits")) << claim;
  }
  // Any numbers are valid in "extras", because glTF gives them no meaning.
  EXPECT_TRUE(Mesh("extras.glb", Glb(TriangleJson(R"(,"extras":{"count":-1})",
                                                  R"({"count":1e300,"byteLength":-7})"),
                                     TriangleData()))
                  .has_value());
}

TEST_F(HostileInputTest, EndlesslyNestedGltfIsRejected) {
  constexpr int kLevels = 200'000;
  const std::string nested = std::string(kLevels, '[') + std::string(kLevels, ']');
  const auto mesh = Mesh("deep.glb", Glb(TriangleJson("", nested), TriangleData()));
  ASSERT_FALSE(mesh.has_value());
  EXPECT_THAT(mesh.error().message, HasSubstr("nested deeper than 64 levels"));
}

}  // namespace
}  // namespace gsv::formats
