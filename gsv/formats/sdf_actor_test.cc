// Tests actors in worlds and in their own files.
#include <memory>

#include <gmock/gmock.h>

#include "gsv/base/test_folder.h"
#include "gsv/formats/sdf_reader.h"
#include "gsv/formats/testing/bending_dae.h"
#include "gsv/model/script.h"

namespace gsv::formats {
namespace {

using geometry::Vector3;
using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr char kTrajectories[] = R"(<script><loop>false</loop><delay_start>1.5</delay_start>
  <trajectory id='1' type='walk'>
    <waypoint><time>3</time><pose>7 0 0 0 0 0</pose></waypoint>
  </trajectory>
  <trajectory id='0' type='walk' tension='0.6'>
    <waypoint><time>2</time><pose>2 0 1 0 0 0</pose></waypoint>
    <waypoint><time>0.5</time><pose>1 0 1 0 0 1.5</pose></waypoint>
  </trajectory></script>)";

class SdfActor : public testing::Test {
 protected:
  model::WorldDescription World(const std::string& content) {
    const std::string text = "<sdf version='1.6'><world name='w'>" + content + "</world></sdf>";
    auto world = ModelLibrary().ReadWorld(folder_.Write("w.sdf", text), problems_);
    EXPECT_TRUE(world.has_value()) << (world ? "" : world.error().Sentence());
    return world.value_or(model::WorldDescription{});
  }
  std::vector<std::string> Sentences() const {
    std::vector<std::string> sentences;
    for (const auto& problem : problems_) sentences.push_back(problem.Sentence());
    return sentences;
  }
  void WriteSkin() {
    folder_.Write("skin.obj",
                  "v -0.2 -0.8 0\nv 0.2 -0.8 0\nv 0.2 0.8 0\nv 0 0 1.8\n"
                  "f 1 2 3\nf 1 2 4\nf 2 3 4\nf 3 1 4\n");
  }

  base::testing::TestFolder folder_;
  base::Problems problems_;
};

TEST_F(SdfActor, ReadsTheScriptInTheOrderOfItsTrajectories) {
  const auto world =
      World("<actor name='a'><pose>10 0 0 0 0 0</pose>" + std::string(kTrajectories) + "</actor>");
  ASSERT_EQ(world.models.size(), 1u);
  const auto& script = world.models[0].model->script;
  ASSERT_NE(script, nullptr);
  EXPECT_FALSE(script->loops);
  EXPECT_TRUE(script->starts_by_itself);
  EXPECT_EQ(script->delay, std::chrono::milliseconds(1500));
  ASSERT_EQ(script->trajectories.size(), 2u);
  const auto& first = script->trajectories[0];
  EXPECT_EQ(first.tension, 0.6);
  // The earliest waypoint is at 0.5 s. The reader adds a waypoint with the same pose at 0 s.
  ASSERT_EQ(first.waypoints.size(), 3u);
  EXPECT_EQ(first.waypoints[0].time.count(), 0);
  EXPECT_EQ(first.waypoints[0].pose, first.waypoints[1].pose);
  EXPECT_EQ(first.waypoints[1].time, std::chrono::milliseconds(500));
  EXPECT_EQ(first.waypoints[2].pose.position, (Vector3{2, 0, 1}));
  // The actor starts at the start of its trajectory.
  EXPECT_EQ(world.models[0].world_from_model.position, (Vector3{11, 0, 1}));
}

TEST_F(SdfActor, ShowsItsSkinAndHasCollisions) {
  WriteSkin();
  const auto world =
      World("<actor name='a'><skin><filename>skin.obj</filename><scale>2</scale></skin></actor>");
  EXPECT_THAT(Sentences(), IsEmpty());
  ASSERT_EQ(world.models.size(), 1u);
  const model::Link& link = world.models[0].model->links.at(0);
  ASSERT_EQ(link.visuals.size(), 1u);
  EXPECT_TRUE(std::holds_alternative<geometry::Mesh>(link.visuals[0].shape));
  ASSERT_EQ(link.collisions.size(), 1u);
  const auto& cylinder = std::get<geometry::Cylinder>(link.collisions[0].shape);
  EXPECT_NEAR(cylinder.radius, 2 * 0.2, 1e-6);
  EXPECT_NEAR(cylinder.length, 2 * 1.8, 1e-6);
  EXPECT_NEAR(link.collisions[0].link_from_collision.position.z, 1.8, 1e-6);
}

TEST_F(SdfActor, IsASimpleFigureIfItsSkinIsMissing) {
  const auto world = World(R"(<actor name='a'><skin><filename>walk.dae</filename></skin><script>
      <trajectory id='0' type='walk'><waypoint><time>0</time><pose>0 0 1.1 0 0 0</pose></waypoint>
      </trajectory></script></actor>)");
  EXPECT_THAT(Sentences(), Contains(HasSubstr("walk.dae is not found")));
  ASSERT_EQ(world.models.size(), 1u);
  const model::Model& actor = *world.models[0].model;
  ASSERT_EQ(actor.links.at(0).collisions.size(), 1u);
  EXPECT_NEAR(model::LowestPoint(actor), -1.1, 1e-6);
}

TEST_F(SdfActor, KeepsItsOwnLinks) {
  const auto world = World(R"(<actor name='a'><link name='l'><collision name='c'><geometry><box>
      <size>1 2 3</size></box></geometry></collision></link></actor>)");
  ASSERT_EQ(world.models.size(), 1u);
  const model::Model& actor = *world.models[0].model;
  ASSERT_NE(actor.script, nullptr);
  ASSERT_EQ(actor.links.size(), 1u);
  ASSERT_EQ(actor.links[0].collisions.size(), 1u);
  EXPECT_TRUE(std::holds_alternative<geometry::Box>(actor.links[0].collisions[0].shape));
}

TEST_F(SdfActor, CanBeInAnIncludedFile) {
  std::filesystem::create_directories(folder_.path() / "walker");
  folder_.Write("walker/model.config",
                "<model><name>walker</name><sdf version='1.6'>model.sdf</sdf></model>");
  folder_.Write("walker/model.sdf", "<sdf version='1.6'><actor name='walker'>" +
                                        std::string(kTrajectories) + "</actor></sdf>");
  const auto world = World(
      "<include><uri>model://walker</uri><pose>0 5 0 0 0 0</pose></include>"
      "<include><uri>model://walker</uri><name>other</name></include>");
  ASSERT_EQ(world.models.size(), 2u);
  EXPECT_EQ(world.models[0].name, "walker");
  EXPECT_EQ(world.models[0].world_from_model.position, (Vector3{1, 5, 1}));
  EXPECT_EQ(world.models[0].model, world.models[1].model);
  ASSERT_NE(world.models[1].model->script, nullptr);
  EXPECT_EQ(world.models[1].world_from_model.position, (Vector3{1, 0, 1}));
}

TEST_F(SdfActor, MovesTheBonesOfItsSkin) {
  folder_.Write("bending.dae", kBendingDae);
  const auto world = World(R"(<actor name='a'><skin><filename>bending.dae</filename></skin>
      <animation name='bend'><filename>bending.dae</filename><interpolate_x>true</interpolate_x>
      </animation><script><trajectory id='0' type='bend'>
      <waypoint><time>0</time><pose>0 0 0 0 0 0</pose></waypoint>
      <waypoint><time>1</time><pose>1 0 0 0 0 0</pose></waypoint></trajectory></script></actor>)");
  EXPECT_THAT(Sentences(), IsEmpty());
  ASSERT_EQ(world.models.size(), 1u);
  const model::Model& actor = *world.models[0].model;
  EXPECT_EQ(actor.links.size(), 1u + 2 * 6);
  ASSERT_EQ(actor.joints.size(), 2u * 6);
  EXPECT_TRUE(actor.script->trajectories.at(0).animated_by_distance);
  ASSERT_NE(actor.script->animation, nullptr);
  const model::Animation& animation = *actor.script->animation;
  EXPECT_EQ(animation.length, std::chrono::seconds(1));
  ASSERT_EQ(animation.frame_count(), 30);
  // Half-way, bone B is rotated by 45 degrees about x.
  EXPECT_NEAR(animation.positions[15 * 12 + 11], 3.14159265358979323846 / 4, 1e-5);
}

TEST_F(SdfActor, KeepsTheShapeOfASkinWithoutBones) {
  WriteSkin();
  const auto world = World(R"(<actor name='a'><skin><filename>skin.obj</filename></skin>
      <animation name='bend'><filename>skin.obj</filename></animation></actor>)");
  EXPECT_THAT(Sentences(), Contains(HasSubstr("the animation is not supported")));
  ASSERT_EQ(world.models.size(), 1u);
  EXPECT_EQ(world.models[0].model->links.at(0).visuals.size(), 1u);
}

TEST_F(SdfActor, ReadsTheValidPartOfInvalidWaypoints) {
  const auto world = World(R"(<actor name='a'><script><auto_start>false</auto_start>
      <trajectory id='0' type='walk' tension='3'>
      <waypoint><time>0</time><pose>1 2 3 0 0 0</pose></waypoint>
      <waypoint><time>4</time><pose>1 two</pose></waypoint></trajectory></script></actor>)");
  EXPECT_THAT(Sentences(), Contains(HasSubstr("<pose> holds \"1 two\"")));
  EXPECT_THAT(Sentences(), Contains(HasSubstr("tension")));
  EXPECT_THAT(Sentences(), Contains(HasSubstr("auto_start")));
  ASSERT_EQ(world.models.size(), 1u);
  const auto& waypoints = world.models[0].model->script->trajectories.at(0).waypoints;
  ASSERT_EQ(waypoints.size(), 2u);
  EXPECT_EQ(waypoints[1].pose.position.x, 1);
  EXPECT_EQ(waypoints[1].pose.position.y, 0);
}

}  // namespace
}  // namespace gsv::formats
