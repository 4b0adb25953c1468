#include "gsv/ros2/robot_descriptions.h"

#include <filesystem>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace gsv::ros2 {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::Not;

std::shared_ptr<model::Model> ModelWith(geometry::Shape shape) {
  auto model = std::make_shared<model::Model>();
  model->name = "robot";
  model::Link link;
  link.name = "base";
  model::Visual visual;
  visual.shape = std::move(shape);
  link.visuals.push_back(std::move(visual));
  model->links.push_back(std::move(link));
  return model;
}

TEST(RobotDescriptions, HaveNoFilesForShapesOfUrdf) {
  RobotDescriptions descriptions;
  const auto text = descriptions.Of(ModelWith(geometry::Box{{1, 1, 1}}));
  ASSERT_TRUE(text) << text.error().Sentence();
  EXPECT_THAT(*text, HasSubstr("<robot name=\"robot\""));
  EXPECT_THAT(*text, HasSubstr("<link name=\"base\""));
  EXPECT_THAT(*text, Not(HasSubstr("://")));
}

TEST(RobotDescriptions, KeepMeshFilesUntilTheyAreDestroyed) {
  auto descriptions = std::make_unique<RobotDescriptions>();
  const auto model = ModelWith(geometry::Cone{0.1, 0.3});
  const auto text = descriptions->Of(model);
  ASSERT_TRUE(text) << text.error().Sentence();
  const std::string scheme = "filename=\"file://";
  const std::size_t begin = text->find(scheme);
  ASSERT_NE(begin, std::string::npos) << *text;
  const std::size_t name = begin + scheme.size();
  const fs::path mesh = text->substr(name, text->find('"', name) - name);
  EXPECT_TRUE(fs::is_regular_file(mesh)) << mesh;
  EXPECT_EQ(descriptions->Of(model).value_or(""), *text);
  descriptions.reset();
  EXPECT_FALSE(fs::exists(mesh.parent_path().parent_path())) << mesh;
}

}  // namespace
}  // namespace gsv::ros2
