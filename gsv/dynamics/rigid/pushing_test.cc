// Tests planar robots together with rigid bodies.
#include <gtest/gtest.h>

#include "gsv/dynamics/testing/test_rigid_world.h"

namespace gsv::dynamics {
namespace {

using geometry::Pose;
using testing::At;
using testing::SolidOf;
using testing::TestWorld;
using testing::WorldOnGround;

// A robot of 20 kg, which pushes with at most 196 N.
std::shared_ptr<model::Model> Robot() {
  auto robot = testing::DiscRobot(0.2);
  robot->links[0].inertial.mass = 20;
  return robot;
}

TEST(Pushing, ARobotPushesABoxAtTheSpeedItDrives) {
  TestWorld world = WorldOnGround();
  world.AddRobot("robot", Robot(), At(0, 0, 0));
  world.AddRigid("box", SolidOf(geometry::Box{{0.3, 0.3, 0.3}}, 2), At(0.6, 0, 0.15));
  ASSERT_TRUE(world.Start());
  world.Command("robot", {0.5, 0, 0});
  world.Run(4, 0.01);
  EXPECT_NEAR(world.position("robot").x, 2, 0.02);
  EXPECT_NEAR(world.position("box").x, world.position("robot").x + 0.35, 0.02);
  EXPECT_GT(world.body("robot").collisions, 0u);
  EXPECT_GT(world.body("box").collisions, 0u);
}

TEST(Pushing, SlowlyAcceleratingRobotPushesAsWell) {
  auto robot = Robot();
  robot->drive->linear_acceleration = {-1, 1};
  TestWorld world = WorldOnGround();
  world.AddRobot("robot", robot, At(0, 0, 0));
  world.AddRigid("box", SolidOf(geometry::Box{{0.3, 0.3, 0.3}}, 2), At(0.36, 0, 0.15));
  ASSERT_TRUE(world.Start());
  world.Command("robot", {0.5, 0, 0});
  world.Run(4, 0.01);
  // Half a second of acceleration (0.125 m), then 3.5 s at 0.5 m/s.
  EXPECT_NEAR(world.position("robot").x, 0.125 + 1.75, 0.1);
}

TEST(Pushing, AHeavyBoxStopsARobot) {
  TestWorld world = WorldOnGround();
  world.AddRobot("robot", Robot(), At(0, 0, 0));
  world.AddRigid("box", SolidOf(geometry::Box{{0.3, 0.3, 0.3}}, 200), At(0.6, 0, 0.15));
  ASSERT_TRUE(world.Start());
  world.Command("robot", {0.5, 0, 0});
  world.Run(4, 0.01);
  EXPECT_NEAR(world.position("robot").x, 0.25, 1e-4);
  EXPECT_NEAR(world.position("box").x, 0.6, 1e-4);
}

TEST(Pushing, ABoxAgainstAWallStopsARobot) {
  // The contact of two boxes is detected once they overlap, by at most the distance of one substep.
  // The robot then stays in contact behind the box.
  constexpr double kSpeed = 0.5, kSolverStep = 1e-3;  // m/s, s
  for (const double wall : {0.85, 0.8501, 0.8503, 0.852, 0.8575}) {
    TestWorld world = WorldOnGround();
    world.AddRobot("robot", Robot(), At(0, 0, 0));
    world.AddRigid("box", SolidOf(geometry::Box{{0.3, 0.3, 0.3}}, 2), At(0.6, 0, 0.15));
    world.AddBox("wall", {0.2, 4, 1}, wall + 0.25, 0);
    ASSERT_TRUE(world.Start());
    world.Command("robot", {kSpeed, 0, 0});
    world.Run(2, 0.01);
    EXPECT_GT(world.position("box").x, wall - 1e-5) << wall;
    EXPECT_LT(world.position("box").x, wall + kSpeed * kSolverStep) << wall;
    EXPECT_NEAR(world.position("robot").x + 0.35, world.position("box").x, 1e-5) << wall;
  }
}

TEST(Pushing, ABallBouncesOffARobotAtRest) {
  TestWorld world = WorldOnGround({0, 0, 0});
  world.AddRobot("robot", Robot(), At(0, 0, 0));
  world.AddRigid("ball", SolidOf(geometry::Sphere{0.1}, 5), At(-2, 0, 0.1));
  ASSERT_TRUE(world.Start());
  world.body("ball").linear_velocity = {2, 0, 0};
  world.Run(3, 0.01);
  EXPECT_EQ(world.position("robot").x, 0);
  EXPECT_LT(world.position("ball").x, -0.3 + 1e-4);
}

TEST(Pushing, BodyOnARobotMovesWithIt) {
  TestWorld world = WorldOnGround();
  world.AddRobot("robot", Robot(), At(0, 0, 0));
  world.AddRigid("parcel", SolidOf(geometry::Box{{0.1, 0.1, 0.1}}, 1), At(0, 0, 0.45));
  ASSERT_TRUE(world.Start());
  world.Command("robot", {0.2, 0, 0});
  world.Run(5, 0.01);
  EXPECT_NEAR(world.position("robot").x, 1, 1e-9);
  // The parcel slips while the robot starts at full speed: v² / (2 g) = 2 mm.
  EXPECT_NEAR(world.position("parcel").x, 1, 0.01);
  EXPECT_NEAR(world.position("parcel").z, 0.45, 1e-4);
}

}  // namespace
}  // namespace gsv::dynamics
