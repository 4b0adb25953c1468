// Tests the <state> of a world.
#include <numbers>

#include <gmock/gmock.h>

#include "gsv/base/test_folder.h"
#include "gsv/formats/sdf_reader.h"

namespace gsv::formats {
namespace {

using geometry::Vector3;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr char kSavedBox[] =
    "<pose>1 0 0 0 0 0</pose><link name='l'><pose>0 0 0.5 0 0 0</pose></link></model>";
constexpr char kSavedArm[] =
    "<model name='arm'><link name='base'/><link name='hand'><pose>1 0 0 0 0 0</pose></link>"
    "<joint name='hinge' type='revolute'><parent>base</parent><child>hand</child>"
    "<pose>-1 0 0 0 0 0</pose><axis><xyz>0 0 1</xyz><limit><lower>-2</lower><upper>2</upper>"
    "</limit></axis></joint></model>";

class WorldStateTest : public ::testing::Test {
 protected:
  model::WorldDescription World(const std::string& content) {
    const std::string text = "<sdf version='1.7'><world name='w'>" + content + "</world></sdf>";
    auto world = ModelLibrary().ReadWorld(folder_.Write("w.sdf", text), problems_);
    EXPECT_TRUE(world.has_value()) << (world ? "" : world.error().Sentence());
    return world.value_or(model::WorldDescription{});
  }

  base::testing::TestFolder folder_;
  base::Problems problems_;
};

TEST_F(WorldStateTest, ReportsTheGapOfALoopThatTheStateOpens) {
  const std::string pin =
      "<joint name='pin' type='revolute'><parent>base</parent><child>hand</child><axis><xyz>0 0 1"
      "</xyz></axis></joint></model>";
  std::string arm = kSavedArm;
  arm.replace(arm.find("</model>"), std::string::npos, pin);
  const auto state = [&](const std::string& angle) {
    return arm + "\n<state world_name='w'><model name='arm'><joint name='hinge'><angle axis='0'>" +
           angle + "</angle></joint></model></state>";
  };
  (void)World(state("0.0005"));
  EXPECT_THAT(problems_, IsEmpty());
  (void)World(state("0.3"));
  // The pin is 1 m from the hinge: its ends are 2 sin(0.15) m apart.
  ASSERT_EQ(problems_.size(), 1u);
  EXPECT_THAT(problems_[0].Sentence(),
              AllOf(HasSubstr("w.sdf:2"), HasSubstr("\"pin\" closes open by 0.299 m")));
}

TEST_F(WorldStateTest, PlacesModelsAndLightsAtTheirSavedPoses) {
  const auto world =
      World("<model name='a'>" + std::string(kSavedBox) + "<model name='b'>" + kSavedBox +
            "<light name='sun' type='point'><pose>0 0 9 0 0 0</pose></light>"
            "<state world_name='w'><sim_time>12 0</sim_time><model name='a'>"
            "<pose>3 4 5 0 0 1.5</pose><scale>1 1 1</scale></model>"
            "<light name='sun'><pose>1 2 3 0 0 0</pose></light></state>");
  EXPECT_THAT(problems_, IsEmpty());
  ASSERT_EQ(world.models.size(), 2u);
  EXPECT_EQ(world.models[0].world_from_model.position, (Vector3{3, 4, 5}));
  EXPECT_NEAR(geometry::Yaw(world.models[0].world_from_model.orientation), 1.5, 1e-12);
  EXPECT_EQ(world.models[1].world_from_model.position, (Vector3{1, 0, 0}));
  ASSERT_EQ(world.lights.size(), 1u);
  EXPECT_EQ(world.lights[0].world_from_light.position, (Vector3{1, 2, 3}));
}

// Gazebo Classic writes the pose of each link in the world; the link's pose takes precedence.
TEST_F(WorldStateTest, PlacesAModelByThePoseOfItsLink) {
  const auto world = World("<model name='a'>" + std::string(kSavedBox) +
                           "<state world_name='w'><model name='a'><pose>7 7 7 0 0 0</pose>"
                           "<link name='l'><pose>2 3 4.5 0 0 0</pose></link></model></state>");
  ASSERT_EQ(world.models.size(), 1u);
  EXPECT_EQ(world.models[0].world_from_model.position, (Vector3{2, 3, 4}));
}

// The hinge is at the base. With the hinge at 0.5 rad, the hand is at (cos 0.5, sin 0.5) relative
// to the base.
TEST_F(WorldStateTest, SetsJointsByThePosesOfTheirLinks) {
  const auto world = World(std::string(kSavedArm) +
                           "<state world_name='w'><model name='arm'><pose>5 0 0 0 0 0</pose>"
                           "<link name='base'><pose>5 0 0 0 0 0</pose></link><link name='hand'>"
                           "<pose>5.8775825618903728 0.479425538604203 0 0 0 0.5</pose></link>"
                           "</model></state>");
  ASSERT_EQ(world.models.size(), 1u);
  ASSERT_EQ(world.models[0].model->start_positions.size(), 1u);
  EXPECT_NEAR(world.models[0].model->start_positions[0], 0.5, 1e-12);
}

TEST_F(WorldStateTest, SetsJointsByTheirAnglesWithoutLinkPoses) {
  const auto world = World(std::string(kSavedArm) +
                           "<state world_name='w'><model name='arm'>"
                           "<joint name='hinge'><angle axis='0'>0.25</angle></joint>"
                           "</model></state>");
  ASSERT_EQ(world.models.size(), 1u);
  ASSERT_EQ(world.models[0].model->start_positions.size(), 1u);
  EXPECT_EQ(world.models[0].model->start_positions[0], 0.25);
}

TEST_F(WorldStateTest, InsertsAndDeletesModels) {
  const auto world =
      World("<model name='a'>" + std::string(kSavedBox) + "<model name='b'>" + kSavedBox +
            "<state world_name='w'><insertions><model name='c'>" + kSavedBox +
            "</insertions><deletions><name>a</name></deletions>"
            "<model name='c'><pose>9 0 0 0 0 0</pose></model></state>");
  ASSERT_EQ(world.models.size(), 2u);
  EXPECT_EQ(world.models[0].name, "b");
  EXPECT_EQ(world.models[1].name, "c");
  EXPECT_EQ(world.models[1].world_from_model.position, (Vector3{9, 0, 0}));
}

TEST_F(WorldStateTest, IgnoresTheStateOfAnotherWorld) {
  const auto world = World("<model name='a'>" + std::string(kSavedBox) +
                           "<state world_name='default'><model name='a'><pose>7 7 7 0 0 0</pose>"
                           "</model></state>");
  EXPECT_EQ(world.models.at(0).world_from_model.position, (Vector3{1, 0, 0}));
  ASSERT_EQ(problems_.size(), 1u);
  EXPECT_THAT(problems_[0].Sentence(), HasSubstr("one of the world \"default\""));
}

TEST_F(WorldStateTest, ReportsModelsThatTheWorldDoesNotHave) {
  World("<model name='a'>" + std::string(kSavedBox) +
        "<state world_name='w'><deletions><name>gone</name></deletions>"
        "<model name='nobody'><pose>1 0 0 0 0 0</pose></model>"
        "<model name='gone'><pose>1 0 0 0 0 0</pose></model>"
        "<model name='a'><pose>1 0 0 0 0 0</pose><link name='wing'><pose>1 0 0 0 0 0</pose></link>"
        "<joint name='hinge'><angle axis='0'>1</angle></joint></model>"
        "<light name='lamp'><pose>0 0 9 0 0 0</pose></light></state>");
  std::vector<std::string> named;
  for (const base::Problem& problem : problems_) named.push_back(problem.Sentence());
  EXPECT_THAT(named, ::testing::UnorderedElementsAre(
                         HasSubstr("model \"nobody\""), HasSubstr("link \"wing\""),
                         HasSubstr("joint \"hinge\""), HasSubstr("light \"lamp\"")));
}

TEST_F(WorldStateTest, ReportsVelocities) {
  World("<model name='a'>" + std::string(kSavedBox) +
        "<state world_name='w'><model name='a'><link name='l'><pose>1 0 0.5 0 0 0</pose>"
        "<velocity>1 0 0 0 0 0</velocity></link></model></state>");
  ASSERT_EQ(problems_.size(), 1u);
  EXPECT_THAT(problems_[0].Sentence(), HasSubstr("the world starts at rest"));
}

}  // namespace
}  // namespace gsv::formats
