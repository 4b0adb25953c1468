// Tests actors among robots and dynamic bodies.
#include <gtest/gtest.h>

#include "gsv/dynamics/testing/test_rigid_world.h"
#include "gsv/model/script.h"

namespace gsv::dynamics {
namespace {

using geometry::PlanarPose;
using testing::TestWorld;

constexpr double kActorStep = 0.01;

// An actor that walks from x = 0 to 4 in 4 s, and back if it loops.
std::shared_ptr<model::Model> WalkerOf(bool loops) {
  auto model = testing::ModelOf(geometry::Cylinder{0.3, 1.8}, PlanarPose(0, 0, 0.9, 0));
  auto script = std::make_shared<model::Script>();
  script->loops = loops;
  model::Trajectory& way = script->trajectories.emplace_back();
  way.waypoints = {{base::SimTime{0}, {}},
                   {base::FromSeconds(4), PlanarPose(4, 0, 0, 0)},
                   {base::FromSeconds(8), PlanarPose(0, 0, 0, 0)}};
  if (!loops) way.waypoints.pop_back();
  model->script = std::move(script);
  return model;
}

TEST(ActorMover, MovesAnActorAlongItsTrajectory) {
  TestWorld world(MakeWorldEngine());
  world.AddActor("walker", WalkerOf(true), PlanarPose(10, 5, 0, 0));
  ASSERT_TRUE(world.Start());
  world.Run(2, kActorStep);
  // Both tangents of the first segment are zero: (4 - 4) / 2 at the closed end, and (0 - 0) / 2
  // where the actor turns back. So the position is 4 (3 u² - 2 u³).
  EXPECT_NEAR(world.position("walker").x, 12, 1e-9);
  EXPECT_NEAR(world.position("walker").y, 5, 1e-12);
  EXPECT_NEAR(world.body("walker").linear_velocity.x, 4 * 1.5 / 4, 1e-4);
  world.Run(14, kActorStep);
  EXPECT_NEAR(world.position("walker").x, 10, 1e-9);
  EXPECT_NEAR(world.body("walker").distance, 16, 1e-9);
}

TEST(ActorMover, JumpToTheStartOfALoopHasZeroVelocity) {
  auto model = WalkerOf(false);
  auto script = std::make_shared<model::Script>(*model->script);
  script->loops = true;
  model->script = script;
  TestWorld world(MakeWorldEngine());
  world.AddActor("walker", model, {});
  ASSERT_TRUE(world.Start());
  world.Run(4, kActorStep);
  EXPECT_NEAR(world.position("walker").x, 0, 1e-9);
  EXPECT_EQ(world.body("walker").linear_velocity, geometry::Vector3{});
  EXPECT_NEAR(world.body("walker").distance, 4, 0.02);
}

TEST(ActorMover, StopsARobotThatRunsIntoIt) {
  TestWorld world(MakeWorldEngine());
  world.AddActor("walker", WalkerOf(false), {});
  world.AddRobot("robot", testing::DiscRobot(), PlanarPose(8, 0, 0, 3.14159265358979323846));
  ASSERT_TRUE(world.Start());
  world.Command("robot", {0.5, 0, 0});
  std::vector<world::Contact> contacts;
  for (int i = 0; i < 900; ++i) contacts = world.Step(kActorStep);
  // The radii are 0.3 m and 0.2 m.
  EXPECT_NEAR(world.position("robot").x, 4.5, 1e-5);
  ASSERT_EQ(contacts.size(), 1u);
  EXPECT_EQ(world.body("robot").collisions, 1u);
}

TEST(ActorMover, WalksThroughARobotAtRest) {
  TestWorld world(MakeWorldEngine());
  world.AddActor("walker", WalkerOf(false), {});
  world.AddRobot("robot", testing::DiscRobot(), PlanarPose(4.3, 0, 0, 0));
  ASSERT_TRUE(world.Start());
  world.Run(5, kActorStep);
  const auto contacts = world.Step(kActorStep);
  ASSERT_EQ(contacts.size(), 1u);
  EXPECT_NEAR(contacts[0].depth, 0.2, 1e-6);
  EXPECT_EQ(world.body("robot").collisions, 1u);
  // The robot cannot move further into the actor, but it can move away from the actor.
  world.Command("robot", {-0.5, 0, 0});
  world.Run(1, kActorStep);
  EXPECT_NEAR(world.position("robot").x, 4.3, 1e-5);
  world.Command("robot", {0.5, 0, 0});
  world.Run(1, kActorStep);
  EXPECT_NEAR(world.position("robot").x, 4.8, 1e-5);
}

TEST(ActorMover, PushesRigidBodies) {
  TestWorld world = testing::WorldOnGround();
  world.AddActor("walker", WalkerOf(false), {});
  world.AddRigid("box", testing::SolidOf(geometry::Box{{0.4, 0.4, 0.4}}, 5),
                 testing::At(2, 0, 0.2));
  ASSERT_TRUE(world.Start());
  world.Run(6, kActorStep);
  EXPECT_NEAR(world.position("walker").x, 4, 1e-9);
  EXPECT_GE(world.position("box").x, 4.5 - 0.02);
  EXPECT_LE(world.position("box").x, 5.5);
}

// One joint that passes through the frames 0, 1, 2, 3 in 2 s, or within 1 m of the path.
std::shared_ptr<model::Model> AnimatedWalker(bool by_distance) {
  auto model = WalkerOf(false);
  model->links.emplace_back().name = "limb";
  model::Joint& joint = model->joints.emplace_back();
  joint.kind = model::JointKind::kContinuous;
  joint.parent = 0;
  joint.child = 1;
  auto script = std::make_shared<model::Script>(*model->script);
  script->trajectories[0].animated_by_distance = by_distance;
  auto animation = std::make_shared<model::Animation>();
  animation->length = base::FromSeconds(2);
  animation->distance = 1;
  animation->joint_count = 1;
  animation->positions = {0, 1, 2, 3};
  script->animation = std::move(animation);
  model->script = std::move(script);
  return model;
}

TEST(ActorMover, SelectsTheAnimationFrameByTime) {
  TestWorld world(MakeWorldEngine());
  world.AddActor("walker", AnimatedWalker(false), {});
  ASSERT_TRUE(world.Start());
  world.Run(0.74, kActorStep);
  EXPECT_EQ(world.joint("walker", 0), 1);
  world.Run(2, kActorStep);  // At 2.74 s the animation has started again.
  EXPECT_EQ(world.joint("walker", 0), 1);
}

TEST(ActorMover, SelectsTheAnimationFrameByDistance) {
  TestWorld world(MakeWorldEngine());
  world.AddActor("walker", AnimatedWalker(true), {});
  ASSERT_TRUE(world.Start());
  // The position is x(t) = 6 u² - 4 u³ + 2 u with u = t / 4.
  for (int i = 1; i <= 390; ++i) {
    world.Step(kActorStep);
    const double u = i * kActorStep / 4, x = 6 * u * u - 4 * u * u * u + 2 * u;
    const double frames = 4 * (x - std::floor(x));
    // The test skips instants that are close to a change of frame.
    if (std::abs(frames - std::round(frames)) < 0.02) continue;
    ASSERT_EQ(world.joint("walker", 0), std::floor(frames)) << x;
  }
}

TEST(ActorMover, IsRepeatable) {
  const auto digest = [] {
    TestWorld world = testing::WorldOnGround();
    world.AddActor("walker", WalkerOf(true), PlanarPose(0.1, 0.2, 0, 0.3));
    world.AddRobot("robot", testing::DiscRobot(), PlanarPose(3, 1, 0, 2));
    EXPECT_TRUE(world.Start());
    world.Command("robot", {0.5, 0, 0.3});
    world.Run(10, kActorStep);
    return world.Digest();
  };
  EXPECT_EQ(digest(), digest());
}

}  // namespace
}  // namespace gsv::dynamics
