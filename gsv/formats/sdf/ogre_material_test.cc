#include "gsv/formats/sdf/ogre_material.h"

#include <gtest/gtest.h>

#include "gsv/formats/sdf/gazebo_materials.h"

namespace gsv::formats {
namespace {

TEST(OgreMaterials, ReadsColoursTexturesAndParents) {
  const auto materials = ParseOgreMaterials(R"(
// A comment { with a brace
material Base/One
{
  technique { pass {
    ambient 0.1 0.2 0.3 1
    diffuse 0.4 0.5 0.6 0.7
    specular 1 1 1 1 12.5
    texture_unit { texture First.png
    scale 2 2 }
    texture_unit { texture second.png }
  } }
}
material Derived/Two : Base/One { technique { pass { diffuse 1 0 0 } } }
)");
  ASSERT_EQ(materials.size(), 2u);
  const OgreMaterial& one = materials.at("Base/One");
  EXPECT_EQ(one.diffuse, (model::Colour{0.4, 0.5, 0.6, 0.7}));
  EXPECT_EQ(one.ambient, (model::Colour{0.1, 0.2, 0.3, 1}));
  EXPECT_EQ(one.specular, (model::Colour{1, 1, 1, 1}));
  EXPECT_EQ(one.shininess, 12.5);
  EXPECT_EQ(one.texture, "First.png");
  EXPECT_EQ(materials.at("Derived/Two").diffuse, (model::Colour{1, 0, 0, 1}));
  EXPECT_EQ(materials.at("Derived/Two").texture, "First.png");
}

TEST(OgreMaterials, ReadsTheIntactPartOfADamagedScript) {
  EXPECT_TRUE(ParseOgreMaterials("").empty());
  EXPECT_TRUE(ParseOgreMaterials("}}}{{{ material").empty());
  const auto materials = ParseOgreMaterials("material A { technique { pass { diffuse red 0 0");
  EXPECT_FALSE(materials.at("A").diffuse.has_value());
}

TEST(GazeboMaterials, KnowsTheNamesAndTheirVariants) {
  EXPECT_EQ(GazeboMaterial("Gazebo/Red")->base_colour, (model::Colour{1, 0, 0, 1}));
  EXPECT_EQ(GazeboMaterial("Gazebo/GreenGlow")->emissive, (model::Colour{0, 1, 0, 1}));
  EXPECT_EQ(GazeboMaterial("Gazebo/BlueTransparent")->base_colour, (model::Colour{0, 0, 1, 0.5}));
  for (const char* name : {"Gazebo/Grey", "Gazebo/Wood", "Gazebo/FlatBlack", "Gazebo/White"}) {
    EXPECT_TRUE(GazeboMaterial(name).has_value()) << name;
  }
  EXPECT_FALSE(GazeboMaterial("Gazebo/NoSuchThing").has_value());
  EXPECT_FALSE(GazeboMaterial("Red").has_value());
}

}  // namespace
}  // namespace gsv::formats
