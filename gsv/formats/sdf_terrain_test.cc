// Tests the textures of a <heightmap>.
#include <gmock/gmock.h>

#include "gsv/base/test_folder.h"
#include "gsv/formats/sdf_reader.h"

namespace gsv::formats {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

// Returns an uncompressed TGA file of one colour.
std::string Tga(int side, unsigned char red, unsigned char green, unsigned char blue) {
  std::string text(18, '\0');
  text[2] = 2;
  text[12] = text[14] = static_cast<char>(side);
  text[16] = 24;
  for (int i = 0; i < side * side; ++i) {
    text += {static_cast<char>(blue), static_cast<char>(green), static_cast<char>(red)};
  }
  return text;
}

class SdfTerrain : public ::testing::Test {
 protected:
  SdfTerrain() {
    folder_.Write("hill.tga", Tga(4, 255, 255, 255));
    folder_.Write("sand.tga", Tga(2, 200, 180, 100));
    folder_.Write("snow.tga", Tga(2, 250, 250, 250));
  }

  // Returns the material of a heightmap that has a height of 3 m everywhere.
  model::Material MaterialOf(const std::string& textures) {
    const std::string map = "<geometry><heightmap><uri>hill.tga</uri><size>10 10 3</size>" +
                            textures + "</heightmap></geometry>";
    const auto path = folder_.Write(
        "hill.sdf",
        "<sdf version='1.6'><model name='hill'><static>true</static><link name='l'>"
        "<collision name='c'>" +
            map + "</collision><visual name='v'>" + map + "</visual></link></model></sdf>");
    const auto model = ModelLibrary().ReadModel(path, problems_);
    EXPECT_TRUE(model.has_value()) << (model ? "" : model.error().Sentence());
    if (!model) return {};
    return (*model)->links.at(0).visuals.at(0).materials.at(0);
  }

  base::testing::TestFolder folder_;
  base::Problems problems_;
};

TEST_F(SdfTerrain, IsDrawnWithItsTexture) {
  const auto material = MaterialOf("<texture><diffuse>sand.tga</diffuse><size>2</size></texture>");
  EXPECT_THAT(problems_, IsEmpty());
  ASSERT_NE(material.base_colour_map, nullptr);
  EXPECT_EQ(material.base_colour_map->pixels.at(0), 200);
  EXPECT_EQ(material.base_colour_map->pixels.at(1), 180);
  EXPECT_EQ(material.base_colour_map->pixels.at(2), 100);
  EXPECT_EQ(material.base_colour, (model::Colour{1, 1, 1, 1}));
}

// Snow begins at a height of 2 m and fades in over 2 m. So at 3 m, sand and snow are mixed equally.
TEST_F(SdfTerrain, BlendsTexturesByHeight) {
  const auto material = MaterialOf(
      "<texture><diffuse>sand.tga</diffuse><size>2</size></texture>"
      "<texture><diffuse>snow.tga</diffuse><size>2</size></texture>"
      "<blend><min_height>2</min_height><fade_dist>2</fade_dist></blend>");
  EXPECT_THAT(problems_, IsEmpty());
  ASSERT_NE(material.base_colour_map, nullptr);
  EXPECT_EQ(material.base_colour_map->pixels.at(0), 225);
  EXPECT_EQ(material.base_colour_map->pixels.at(2), 175);
}

TEST_F(SdfTerrain, WithoutItsTextureIsGreyWithAWarning) {
  const auto material = MaterialOf("<texture><diffuse>none.tga</diffuse><size>2</size></texture>");
  EXPECT_EQ(material.base_colour_map, nullptr);
  ASSERT_EQ(problems_.size(), 1u);
  EXPECT_THAT(problems_[0].Sentence(),
              HasSubstr("the terrain is drawn in grey instead of a texture"));
}

}  // namespace
}  // namespace gsv::formats
