// Files that are made to do harm, or that harm has been done to: read without harm, with a
// sentence.
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
  // What is said of a model's file, whether it can be read or not.
  std::vector<std::string> SaidOf(const std::string& name, const std::string& text) {
    base::Problems problems;
    const auto model = ModelLibrary().ReadModel(folder_.Write(name, text).string(), problems);
    std::vector<std::string> said;
    for (const base::Problem& problem : problems) said.push_back(problem.Sentence());
    if (!model) said.push_back(model.error().Sentence());
    model_ = model ? *model : nullptr;
    return said;
  }
  std::vector<std::string> SaidOfModel(const std::string& content) {
    return SaidOf("m.sdf", "<sdf version='1.9'>\n<model name='m'>\n" + content + "</model></sdf>");
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

// Ten names, each of them ten times the one before.
TEST_F(HostileInputTest, EntitiesAreNotExpanded) {
  std::string text = "<?xml version='1.0'?><!DOCTYPE sdf [<!ENTITY a0 'ha'>";
  for (int i = 1; i < 10; ++i) {
    text += "<!ENTITY a" + std::to_string(i) + " '";
    for (int k = 0; k < 10; ++k) text += "&a" + std::to_string(i - 1) + ";";
    text += "'>";
  }
  text += "]><sdf version='1.9'><model name='&a9;'><link name='l'/></model></sdf>";
  (void)SaidOf("m.sdf", text);
  if (model_ != nullptr) {
    EXPECT_LT(model_->name.size(), 100u);
  }
}

TEST_F(HostileInputTest, ValuesThatAreNotFiniteAreComplainedOfWithTheirPlace) {
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
    EXPECT_THAT(SaidOfModel(content), Contains(HasSubstr("m.sdf:"))) << content;
    if (model_ == nullptr) continue;
    for (const model::Link& link : model_->links) {
      EXPECT_TRUE(std::isfinite(link.inertial.mass)) << content;
      EXPECT_TRUE(geometry::IsFinite(link.model_from_link)) << content;
    }
  }
}

TEST_F(HostileInputTest, AUrdfThatIsCutOffIsRefused) {
  const std::string urdf =
      "<robot name='r'>\n<link name='a'><inertial><mass value='1'/></inertial></link>\n</robot>";
  for (const std::size_t length : {std::size_t{20}, urdf.size() / 2, urdf.size() - 3}) {
    EXPECT_THAT(SaidOf("r.urdf", urdf.substr(0, length)), Contains(HasSubstr("malformed")));
  }
}

std::string Gltf(const std::string& index_bytes, int byte_length) {
  // Three corners as floats, then three indices.
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

TEST_F(HostileInputTest, AGltfWhoseIndicesOrBuffersReachTooFarIsRefused) {
  EXPECT_TRUE(Mesh("good.gltf", Gltf("AAEC", 39)).has_value());    // 0, 1, 2
  EXPECT_FALSE(Mesh("index.gltf", Gltf("AAH/", 39)).has_value());  // 0, 1, 255
  EXPECT_FALSE(Mesh("short.gltf", Gltf("", 39)).has_value());
  EXPECT_FALSE(Mesh("huge.gltf", Gltf("AAEC", 2'000'000'000)).has_value());
}

}  // namespace
}  // namespace gsv::formats
