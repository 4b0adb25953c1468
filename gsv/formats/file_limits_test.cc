// Tests each limit on files: a file at the limit is read. If the limit is lower by one, the file is
// refused, or the part beyond the limit is left out.
#include <functional>

#include <gmock/gmock.h>

#include "gsv/base/test_folder.h"
#include "gsv/formats/images/texture_reader.h"
#include "gsv/formats/meshes/mesh_reader.h"
#include "gsv/formats/sdf_reader.h"

namespace gsv::formats {
namespace {

using testing::HasSubstr;

class FileLimitsTest : public testing::Test {
 protected:
  using Reads = std::function<base::Status(const ReadLimits&)>;

  // Checks the limit with this name, by a file for which `needed` is just enough.
  static void ExpectLimit(const std::string& name, std::size_t needed, const Reads& reads) {
    ReadLimits limits;
    ASSERT_TRUE(SetLimit(name + "=" + std::to_string(needed), limits));
    const base::Status met = reads(limits);
    EXPECT_TRUE(met) << name << ": " << met.error().Sentence();
    ASSERT_TRUE(SetLimit(name + "=" + std::to_string(needed - 1), limits));
    const base::Status beyond = reads(limits);
    ASSERT_FALSE(beyond) << name;
    EXPECT_THAT(beyond.error().Sentence(), HasSubstr(std::to_string(needed - 1))) << name;
  }
  Reads World(const std::string& content) const {
    return [this, content](const ReadLimits& limits) -> base::Status {
      ReadOptions options;
      options.limits = limits;
      base::Problems problems;
      const auto world = ModelLibrary(options).ReadWorld(folder_.Write("w.sdf", content), problems);
      if (!world) return base::Fail(world.error());
      for (const base::Problem& problem : problems) {
        return base::Fail(base::ErrorCode::kBadModel, problem.message, problem.where);
      }
      return {};
    };
  }
  Reads Mesh(const std::string& name, const std::string& content) const {
    return [this, name, content](const ReadLimits& limits) -> base::Status {
      TextureReader textures(limits);
      base::Problems problems;
      const auto mesh =
          MeshReader(limits, textures).Read(folder_.Write(name, content), "", false, problems);
      return mesh ? base::Status() : base::Fail(mesh.error());
    };
  }

  base::testing::TestFolder folder_;
};

TEST_F(FileLimitsTest, LimitsOfWorldsAreEnforced) {
  // The depth of elements is four: sdf, world, model, link.
  const std::string world =
      "<sdf version='1.9'><world name='w'><model name='a'><link name='l'/></model>"
      "<model name='b'><link name='l'/></model></world></sdf>";
  ExpectLimit("xml_bytes", world.size(), World(world));
  ExpectLimit("xml_depth", 4, World(world));
  ExpectLimit("models_in_world", 2, World(world));
}

TEST_F(FileLimitsTest, LimitsOfIncludesAreEnforced) {
  const auto model = [](const std::string& content) {
    return "<sdf version='1.9'><model name='m'><link name='l'/>" + content + "</model></sdf>";
  };
  const auto include = [](const std::string& name) {
    return "<include><uri>model://" + name + "</uri></include>";
  };
  folder_.Write("a/model.sdf", model(include("b")));
  folder_.Write("b/model.sdf", model(include("c")));
  folder_.Write("c/model.sdf", model(""));
  // The depth counts from the model that the world includes.
  ExpectLimit("include_depth", 2,
              World("<sdf version='1.9'><world name='w'>" + include("a") + "</world></sdf>"));
}

TEST_F(FileLimitsTest, LimitsOfMeshesAreEnforced) {
  const std::string square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3\nf 1 3 4\n";
  ExpectLimit("mesh_bytes", square.size(), Mesh("a.obj", square));
  ExpectLimit("mesh_triangles", 2, Mesh("a.obj", square));
  ExpectLimit("mesh_vertices", 3, Mesh("b.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\n"));
}

TEST_F(FileLimitsTest, LimitsOfImagesAreEnforced) {
  std::string picture(18, '\0');  // TGA: 3 by 2 pixels of 24 bits
  picture[2] = 2, picture[12] = 3, picture[14] = 2, picture[16] = 24;
  picture += std::string(18, 'x');
  const auto reads = [&](const ReadLimits& limits) -> base::Status {
    TextureReader reader(limits);
    const auto image = reader.Read(folder_.Write("a.tga", picture));
    if (!image) return base::Fail(image.error());
    if ((*image)->width == 3) return {};
    return base::Fail(base::ErrorCode::kBadModel,
                      "scaled down to at most " + std::to_string(limits.texture_side));
  };
  ExpectLimit("texture_bytes", picture.size(), reads);
  ExpectLimit("texture_side", 3, reads);
}

}  // namespace
}  // namespace gsv::formats
