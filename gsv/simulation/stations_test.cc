// Tests stations: bodies with sensors but without a drive.
#include <gtest/gtest.h>

#include "gsv/simulation/testing/test_simulation.h"

namespace gsv::simulation {
namespace {

// A station: a sonar on a post, which is a disc without a drive.
std::shared_ptr<model::Model> Post() {
  auto post = std::make_shared<model::Model>(*Disc(0.1));
  post->name = "post";
  post->drive.reset();
  return post;
}

// A world with a post 2 m to the left of the origin. The wall's face is at x = 2.9 m.
std::shared_ptr<Simulation> WorldWithPost(SimTime duration = 1s) {
  Specification specification = Lockstep(duration);
  auto world = std::make_shared<model::WorldDescription>(*specification.world);
  world->models.push_back({"post", Post(), PlanarPose(0, 2, 0, 0), true});
  specification.world = world;
  return Make(specification);
}

TEST(Stations, AreReadLikeRobots) {
  const auto simulation = WorldWithPost();
  ASSERT_NE(simulation->agent("post"), nullptr);
  ASSERT_EQ(simulation->sensors("post").size(), 1u);
  const auto reading = simulation->Watch("post", "front");
  ASSERT_TRUE(reading) << reading.error().Sentence();
  EXPECT_NEAR(reading->values.at(0), 2.9, 1e-6);
  EXPECT_EQ(simulation->agent("wall"), nullptr);
}

TEST(Stations, AreListedAsStationsAndNotCountedAsRobots) {
  const auto simulation = WorldWithPost();
  ASSERT_TRUE(simulation->AddRobot(Robot("robot", 0, 0)));
  EXPECT_TRUE(StatusOf(*simulation, "post").is_station);
  EXPECT_FALSE(StatusOf(*simulation, "robot").is_station);
  EXPECT_EQ(simulation->status().robots.size(), 2u);
  EXPECT_EQ(simulation->status().CountRobots(), 1u);
}

TEST(Stations, MayHaveABehaviourThatOnlyReads) {
  const auto simulation = WorldWithPost();
  ASSERT_TRUE(simulation->SetBehaviour("post", Drives(1)));
  ASSERT_EQ(RunToEnd(*simulation), Phase::kFinished);
  EXPECT_EQ(PoseOf(*simulation, "post").position.x, 0);
  EXPECT_EQ(StatusOf(*simulation, "post").distance, 0);
}

TEST(Stations, AreAddedAndRemovedAsObjects) {
  const auto simulation = WorldWithPost();
  ObjectSpecification object;
  object.model = Post();
  object.world_from_object = PlanarPose(0, -2, 0, 0);
  const auto name = simulation->AddObject(object);
  ASSERT_TRUE(name) << name.error().Sentence();
  EXPECT_EQ(simulation->sensors(*name).size(), 1u);
  const auto as_robot = simulation->RemoveRobot(*name);
  ASSERT_FALSE(as_robot);
  EXPECT_EQ(as_robot.error().message, "the body is not a robot; remove it as an object");
  ASSERT_TRUE(simulation->RemoveObject(*name));
  EXPECT_EQ(simulation->agent(*name), nullptr);
  EXPECT_FALSE(simulation->Watch(*name, "front"));
}

TEST(Stations, StayAfterAReset) {
  const auto simulation = WorldWithPost(100ms);
  ASSERT_EQ(RunToEnd(*simulation), Phase::kFinished);
  ASSERT_TRUE(simulation->Reset());
  EXPECT_TRUE(simulation->Watch("post", "front"));
}

}  // namespace
}  // namespace gsv::simulation
