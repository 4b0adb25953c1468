#include "gsv/formats/sdf/shape_model.h"

#include <gmock/gmock.h>

#include "gsv/formats/sdf_reader.h"

namespace gsv::formats {
namespace {

using testing::HasSubstr;

std::shared_ptr<const model::Model> ReadShape(const std::string& name) {
  base::Problems problems;
  const auto model = ModelLibrary().ReadModel(name, problems);
  EXPECT_TRUE(model) << (model ? "" : model.error().Sentence());
  EXPECT_TRUE(problems.empty());
  return model.value_or(nullptr);
}

TEST(ShapeModel, BoxHasItsSizeMassAndInertia) {
  const auto box = ReadShape("shape:box?size=0.2,0.4,0.6&mass=12&colour=ff0080");
  EXPECT_EQ(box->name, "box");
  EXPECT_FALSE(box->is_static);
  ASSERT_EQ(box->links.size(), 1u);
  const model::Link& link = box->links[0];
  ASSERT_EQ(link.collisions.size(), 1u);
  EXPECT_EQ(std::get<geometry::Box>(link.collisions[0].shape).size,
            (geometry::Vector3{0.2, 0.4, 0.6}));
  EXPECT_EQ(link.inertial.mass, 12);
  EXPECT_NEAR(link.inertial.ixx, 0.16 + 0.36, 1e-12);  // m/12 (y² + z²)
  EXPECT_NEAR(link.inertial.izz, 0.04 + 0.16, 1e-12);
  EXPECT_NEAR(link.visuals.at(0).materials.at(0).base_colour.r, 1, 1e-6);
  EXPECT_NEAR(link.visuals.at(0).materials.at(0).base_colour.b, 128 / 255.0, 1e-6);
}

TEST(ShapeModel, WallIsStaticAndRoundShapesHaveTheirRadius) {
  EXPECT_TRUE(ReadShape("shape:wall?size=4,0.1,2")->is_static);
  EXPECT_TRUE(ReadShape("shape:sphere?radius=0.3&static=true")->is_static);
  const auto sphere = ReadShape("shape:sphere?radius=0.5&mass=2");
  EXPECT_NEAR(sphere->links[0].inertial.ixx, 0.4 * 2 * 0.25, 1e-12);  // 2/5 m r²
  const auto cylinder = ReadShape("shape:cylinder?radius=0.5&length=3");
  const auto& shape = std::get<geometry::Cylinder>(cylinder->links[0].collisions[0].shape);
  EXPECT_EQ(shape.radius, 0.5);
  EXPECT_EQ(shape.length, 3);
  EXPECT_NEAR(cylinder->links[0].inertial.ixx, (3 * 0.25 + 9) / 12, 1e-12);
}

TEST(ShapeModel, InvalidNamesAreRejectedWithTheReason) {
  const struct {
    const char* name;
    const char* fault;
  } kCases[]{
      {"shape:", "there is no shape \"\""},
      {"shape:cone?radius=1", "use box, wall, cylinder or sphere"},
      {"shape:box", "size is missing"},
      {"shape:box?size=1,2", "needs 3 numbers"},
      {"shape:box?size=1,2,3,4", "needs 3 numbers"},
      {"shape:box?size=1,2,-3", "not \"-3\""},
      {"shape:box?size=1,2,nan", "not \"nan\""},
      {"shape:box?size=1,2,1e9", "0.001 to 1000"},
      {"shape:box?size=1,1,1&mass=0", "mass must be"},
      {"shape:box?size=1,1,1&static=yes", "true or false"},
      {"shape:box?size=1,1,1&colour=red", "hexadecimal"},
      {"shape:box?size=1,1,1&weight=3", "no option \"weight\""},
      {"shape:box?size", "NAME=VALUE"},
      {"shape:sphere?radius=", "not \"\""},
  };
  for (const auto& each : kCases) {
    const auto read = SdfOfShape(each.name);
    ASSERT_FALSE(read) << each.name;
    EXPECT_THAT(read.error().Sentence(), HasSubstr(each.fault));
  }
  EXPECT_FALSE(SdfOfShape("shape:box?size=1,1,1&colour=" + std::string(400, 'f')));
}

}  // namespace
}  // namespace gsv::formats
