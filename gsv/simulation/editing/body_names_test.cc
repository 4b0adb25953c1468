#include "gsv/simulation/editing/body_names.h"

#include <gmock/gmock.h>

namespace gsv::simulation {
namespace {

std::shared_ptr<const model::Model> NamedModel(const std::string& name) {
  auto model = std::make_shared<model::Model>();
  model->name = name;
  model->links.resize(1);
  return model;
}

std::shared_ptr<const world::Layout> LayoutWith(const std::vector<std::string>& names) {
  std::vector<world::Body> bodies;
  for (const std::string& name : names) {
    world::Body& body = bodies.emplace_back();
    body.name = name;
    body.model = NamedModel("model");
  }
  return world::MakeLayout(1, std::move(bodies), std::make_shared<model::WorldDescription>());
}

RobotSpecification Named(std::string name, const std::string& model) {
  RobotSpecification robot;
  robot.name = std::move(name);
  robot.model = NamedModel(model);
  return robot;
}

TEST(BodyNames, HaveAtMost128CharactersAndNoSlash) {
  EXPECT_TRUE(CheckBodyName(std::string(128, 'a')));
  EXPECT_FALSE(CheckBodyName(std::string(129, 'a')));
  EXPECT_FALSE(CheckBodyName("a/b"));
}

TEST(BodyNames, FreeNameIsTheModelsNameOrItsFirstFreeNumber) {
  EXPECT_EQ(FreeName(*LayoutWith({}), "box"), "box");
  EXPECT_EQ(FreeName(*LayoutWith({"box"}), "box"), "box_2");
  EXPECT_EQ(FreeName(*LayoutWith({"box", "box_2", "box_4"}), "box"), "box_3");
}

TEST(BodyNames, RobotsWithoutANameGetAUniqueName) {
  std::vector<RobotSpecification> robots{Named("", "disc"), Named("disc_2", "disc"),
                                         Named("", "disc"), Named("", "cart")};
  ASSERT_TRUE(NameRobots(*LayoutWith({"disc"}), robots));
  std::vector<std::string> names;
  names.reserve(robots.size());
  for (const RobotSpecification& robot : robots) names.push_back(robot.name);
  EXPECT_THAT(names, testing::ElementsAre("disc_3", "disc_2", "disc_4", "cart"));
}

TEST(BodyNames, DuplicateNameIsRejected) {
  std::vector<RobotSpecification> as_a_body{Named("box", "disc")};
  EXPECT_FALSE(NameRobots(*LayoutWith({"box"}), as_a_body));
  std::vector<RobotSpecification> twice{Named("robot", "disc"), Named("robot", "disc")};
  EXPECT_FALSE(NameRobots(*LayoutWith({}), twice));
}

}  // namespace
}  // namespace gsv::simulation
