
#include <gtest/gtest.h>

#include "gsv/base/test_within.h"
#include "gsv/dynamics/testing/test_world.h"
#include "gsv/dynamics/world_engine.h"
#include "gsv/geometry/constants.h"

namespace gsv::dynamics {
namespace {

using geometry::PlanarPose;
using testing::BoxRobot;
using testing::DiscRobot;
using testing::TestWorld;

using geometry::kPi;
constexpr double kGap = 1e-6;  // gap between bodies that touch

TestWorld Empty() { return TestWorld(MakeWorldEngine()); }

TEST(PlanarMover, DrivesAHalfCircleExactly) {
  TestWorld world = Empty();
  world.AddRobot("robot", DiscRobot(), PlanarPose(1, 2, 0.5, 0));
  ASSERT_TRUE(world.Start());
  // The radius is v / w = 2 m. After pi seconds at 1 rad/s the robot is on the opposite side of the
  // circle.
  world.Command("robot", {2, 0, 1});
  const double step = base::ToSeconds(base::FromSeconds(kPi / 100));
  world.Run(100 * step, step);
  const double angle = 100 * step;
  EXPECT_WITHIN(world.position("robot").x, 1 + 2 * std::sin(angle), 1e-12, "m");
  EXPECT_WITHIN(world.position("robot").y, 2 + 2 * (1 - std::cos(angle)), 1e-12, "m");
  EXPECT_EQ(world.position("robot").z, 0.5);
  EXPECT_NEAR(geometry::WrapAngle(world.yaw("robot") - angle), 0, 1e-12);
  EXPECT_NEAR(world.body("robot").distance, 2 * angle, 1e-12);
}

TEST(PlanarMover, ReturnsToTheStartOfASquare) {
  TestWorld world = Empty();
  world.AddRobot("robot", DiscRobot(), PlanarPose(3, -1, 0, 0.3));
  ASSERT_TRUE(world.Start());
  for (int side = 0; side < 4; ++side) {
    world.Command("robot", {0.5, 0, 0});
    world.Run(2, 0.01);
    world.Command("robot", {0, 0, kPi / 2});
    world.Run(1, 0.01);
  }
  EXPECT_NEAR(world.position("robot").x, 3, 1e-12);
  EXPECT_NEAR(world.position("robot").y, -1, 1e-12);
  EXPECT_NEAR(world.yaw("robot"), 0.3, 1e-12);
  EXPECT_NEAR(world.body("robot").distance, 4, 1e-12);
}

TEST(PlanarMover, KeepsRollAndPitch) {
  TestWorld world = Empty();
  const auto tilted = geometry::FromRollPitchYaw({0.1, -0.2, 0.5});
  world.AddRobot("robot", DiscRobot(), {{0, 0, 0}, tilted});
  ASSERT_TRUE(world.Start());
  world.Command("robot", {0, 0, 1});
  world.Run(1, 0.01);
  const auto angles = geometry::ToRollPitchYaw(world.body("robot").world_from_model.orientation);
  EXPECT_NEAR(angles.roll, 0.1, 1e-9);
  EXPECT_NEAR(angles.pitch, -0.2, 1e-9);
  EXPECT_NEAR(angles.yaw, 1.5, 1e-9);
}

TEST(PlanarMover, StopsAtAWall) {
  TestWorld world = Empty();
  world.AddRobot("robot", DiscRobot(0.2), PlanarPose(0, 0, 0, 0));
  world.AddBox("wall", {0.1, 4, 1}, 2, 0);
  ASSERT_TRUE(world.Start());
  world.Command("robot", {0.7, 0, 0});
  world.Run(5, 0.01);
  EXPECT_WITHIN(world.position("robot").x, 2 - 0.05 - 0.2, kGap, "m");
  EXPECT_LT(world.position("robot").x, 2 - 0.05 - 0.2);
  EXPECT_EQ(world.body("robot").linear_velocity, geometry::Vector3{});
  EXPECT_EQ(world.body("robot").collisions, 1u);
  EXPECT_TRUE(world.body("robot").in_contact);
  EXPECT_NEAR(world.body("robot").distance, 1.75, kGap);
}

TEST(PlanarMover, DoesNotTunnelThroughAThinWall) {
  for (const double yaw : {0.0, 0.3, 1.0}) {
    TestWorld world = Empty();
    world.AddRobot("robot", BoxRobot(0.4, 0.3), PlanarPose(0, 0, 0, yaw));
    // The wall is a millimetre thick and two metres ahead.
    world.AddBox("wall", {0.001, 40, 1}, 2 * std::cos(yaw), 2 * std::sin(yaw), 0, yaw);
    ASSERT_TRUE(world.Start());
    world.Command("robot", {10, 0, 0});
    for (int i = 0; i < 20; ++i) world.Step(0.1);
    const auto& p = world.position("robot");
    EXPECT_WITHIN(std::hypot(p.x, p.y), 2 - 0.0005 - 0.2, kGap, "m") << yaw;
  }
}

TEST(PlanarMover, ReportsTheStartOfAContactOnce) {
  TestWorld world = Empty();
  world.AddRobot("robot", DiscRobot(0.2), PlanarPose(0, 0, 0, 0));
  world.AddBox("wall", {0.1, 4, 1}, 0.3, 0);  // The wall is 5 cm ahead.
  ASSERT_TRUE(world.Start());
  world.Command("robot", {1, 0, 0});
  EXPECT_TRUE(world.Step(0.01).empty());
  world.Run(0.03, 0.01);
  auto contacts = world.Step(0.02);
  ASSERT_EQ(contacts.size(), 1u);
  EXPECT_EQ(contacts[0].first, world.layout().Find("robot"));
  EXPECT_EQ(contacts[0].second, world.layout().Find("wall"));
  EXPECT_TRUE(contacts[0].began);
  EXPECT_NEAR(contacts[0].normal.x, 1, 1e-9);
  EXPECT_NEAR(contacts[0].point.x, 0.25, kGap);
  EXPECT_NEAR(contacts[0].point.y, 0, 1e-9);
  for (int i = 0; i < 5; ++i) {
    contacts = world.Step(0.01);
    ASSERT_EQ(contacts.size(), 1u);
    EXPECT_FALSE(contacts[0].began);
  }
  EXPECT_EQ(world.body("robot").collisions, 1u);
  // The robot drives away and back, and collides again.
  world.Command("robot", {-1, 0, 0});
  world.Run(0.1, 0.01);
  EXPECT_FALSE(world.body("robot").in_contact);
  world.Command("robot", {1, 0, 0});
  world.Run(0.2, 0.01);
  EXPECT_EQ(world.body("robot").collisions, 2u);
}

TEST(PlanarMover, TurnsOnTheSpotAgainstAWallAndDrivesAway) {
  TestWorld world = Empty();
  world.AddRobot("robot", DiscRobot(0.2), PlanarPose(0, 0, 0, 0));
  world.AddBox("wall", {0.1, 4, 1}, 0.5, 0);
  ASSERT_TRUE(world.Start());
  world.Command("robot", {1, 0, 1});
  world.Run(3, 0.01);
  // After three seconds at 1 rad/s, the robot has rotated by 3 rad, although it touched the wall.
  // It has also driven away from the wall.
  EXPECT_NEAR(world.yaw("robot"), 3, 1e-9);
  EXPECT_LT(world.position("robot").x, 0.2);
  EXPECT_FALSE(world.body("robot").in_contact);
}

TEST(PlanarMover, BoxDoesNotRotateIntoAWall) {
  TestWorld world = Empty();
  world.AddRobot("robot", BoxRobot(0.6, 0.2), PlanarPose(0, 0, 0, 0));
  world.AddBox("wall", {4, 0.1, 1}, 0, 0.25);  // the wall's face is 0.1 m from the robot's side
  ASSERT_TRUE(world.Start());
  world.Command("robot", {0, 0, 1});
  world.Run(3, 0.01);
  // The corner (0.3, 0.1) reaches y = 0.2 where 0.3 sin a + 0.1 cos a = 0.2.
  const double diagonal = std::hypot(0.3, 0.1);
  const double expected = std::asin(0.2 / diagonal) - std::atan2(0.1, 0.3);
  EXPECT_NEAR(world.yaw("robot"), expected, 1e-5);
  EXPECT_EQ(world.body("robot").angular_velocity.z, 0);
  // The robot can turn back.
  world.Command("robot", {0, 0, -1});
  world.Run(0.1, 0.01);
  EXPECT_NEAR(world.yaw("robot"), expected - 0.1, 1e-5);
}

TEST(PlanarMover, HeadOnRobotsMeetInTheMiddle) {
  TestWorld world = Empty();
  world.AddRobot("a", DiscRobot(0.2), PlanarPose(-1, 0, 0, 0));
  world.AddRobot("b", DiscRobot(0.2), PlanarPose(1, 0, 0, kPi));
  ASSERT_TRUE(world.Start());
  world.Command("a", {0.5, 0, 0});
  world.Command("b", {0.5, 0, 0});
  world.Run(3, 0.07);
  EXPECT_NEAR(world.position("a").x, -0.2, kGap);
  EXPECT_NEAR(world.position("b").x, 0.2, kGap);
  EXPECT_NEAR(world.position("a").x + world.position("b").x, 0, 1e-12);  // the result favours
                                                                         // neither robot
  EXPECT_EQ(world.body("a").collisions, 1u);
  EXPECT_EQ(world.body("b").collisions, 1u);
}

TEST(PlanarMover, RobotThatIsHitFromBehindContinues) {
  TestWorld world = Empty();
  world.AddRobot("fast", DiscRobot(0.2), PlanarPose(0, 0, 0, 0));
  world.AddRobot("slow", DiscRobot(0.2), PlanarPose(0.5, 0, 0, 0));
  ASSERT_TRUE(world.Start());
  world.Command("fast", {1, 0, 0});
  world.Command("slow", {0.25, 0, 0});
  world.Run(4, 0.01);
  EXPECT_NEAR(world.position("slow").x, 0.5 + 0.25 * 4, 1e-9);
  EXPECT_LT(world.position("fast").x, world.position("slow").x - 0.4);
  EXPECT_GT(world.position("fast").x, world.position("slow").x - 0.42);
}

TEST(PlanarMover, RobotsOnDifferentFloorsPassEachOther) {
  TestWorld world = Empty();
  world.AddRobot("a", DiscRobot(0.2), PlanarPose(-1, 0, 0, 0));
  world.AddRobot("b", DiscRobot(0.2), PlanarPose(1, 0, 3, kPi));
  ASSERT_TRUE(world.Start());
  world.Command("a", {1, 0, 0});
  world.Command("b", {1, 0, 0});
  world.Run(2, 0.01);
  EXPECT_NEAR(world.position("a").x, 1, 1e-9);
  EXPECT_NEAR(world.position("b").x, -1, 1e-9);
}

TEST(PlanarMover, FloorIsNoObstacleButItsEdgeIsAnObstacle) {
  TestWorld world = Empty();
  world.AddBox("slab", {6, 6, 0.19}, 0, 0);
  world.AddRobot("inside", DiscRobot(0.2), PlanarPose(0, 0, 0.19, 0));
  world.AddRobot("outside", DiscRobot(0.2), PlanarPose(5, 1, 0, kPi));
  ASSERT_TRUE(world.Start());
  world.Command("inside", {1, 0, 0});
  world.Command("outside", {1, 0, 0});
  world.Run(2.5, 0.01);
  EXPECT_NEAR(world.position("inside").x, 2.5, 1e-9);
  EXPECT_NEAR(world.position("outside").x, 3.2, kGap);
}

TEST(PlanarMover, DrivesUnderATableAndStopsAtItsLegs) {
  TestWorld world = Empty();
  world.AddBox("top", {2, 2, 0.05}, 2, 0, 0.7);
  world.AddStatic("leg", testing::ModelOf(geometry::Cylinder{0.05, 0.7}),
                  PlanarPose(2, 0, 0.35, 0));
  world.AddRobot("low", DiscRobot(0.2), PlanarPose(0, 0, 0, 0));
  ASSERT_TRUE(world.Start());
  world.Command("low", {1, 0, 0});
  world.Run(4, 0.01);
  EXPECT_NEAR(world.position("low").x, 2 - 0.05 - 0.2, kGap);
}

TEST(PlanarMover, MeshWallIsAnObstacle) {
  auto mesh = std::make_shared<geometry::TriangleMesh>();
  mesh->positions = {{0, -2, 0}, {0, 2, 0}, {0, 2, 2}, {0, -2, 2}};
  mesh->triangles = {{0, 1, 2}, {0, 2, 3}};
  TestWorld world = Empty();
  world.AddStatic("wall", testing::ModelOf(geometry::Mesh{mesh, {1, 1, 1}}),
                  PlanarPose(1, 0, 0, 0));
  world.AddRobot("robot", DiscRobot(0.2), PlanarPose(0, 0.3, 0, 0));
  ASSERT_TRUE(world.Start());
  world.Command("robot", {30, 0, 0});
  const auto contacts = world.Step(0.1);
  EXPECT_NEAR(world.position("robot").x, 0.8, kGap);
  EXPECT_EQ(contacts.size(), 1u);
}

TEST(PlanarMover, GroundPlaneIsNoObstacleAndSteepPlaneIsAWall) {
  TestWorld world = Empty();
  world.AddStatic("ground", testing::ModelOf(geometry::Plane{{0, 0, 1}, {100, 100}}), {});
  world.AddStatic("wall", testing::ModelOf(geometry::Plane{{-1, 0, 0}, {1, 1}}),
                  PlanarPose(3, 50, 0, 0));
  world.AddRobot("robot", DiscRobot(0.2), PlanarPose(0, 0, 0, 0));
  ASSERT_TRUE(world.Start());
  world.Command("robot", {1, 0, 0});
  world.Run(4, 0.01);
  EXPECT_NEAR(world.position("robot").x, 2.8, kGap);
}

TEST(PlanarMover, OmnidirectionalBaseSlidesAlongAWall) {
  TestWorld world = Empty();
  world.AddRobot("robot",
                 testing::RobotOf(geometry::Cylinder{0.2, 0.4}, 0.4, model::DriveKind::kVelocity),
                 PlanarPose(0, 0, 0, 0));
  world.AddBox("wall", {0.1, 40, 1}, 0.5, 0);
  ASSERT_TRUE(world.Start());
  world.Command("robot", {1, 1, 0});
  world.Run(3, 0.01);
  EXPECT_NEAR(world.position("robot").x, 0.25, kGap);
  EXPECT_NEAR(world.position("robot").y, 3, 1e-5);
  EXPECT_NEAR(world.body("robot").linear_velocity.x, 0, 1e-9);
  EXPECT_NEAR(world.body("robot").linear_velocity.y, 1, 1e-9);
  EXPECT_EQ(world.body("robot").collisions, 1u);
}

TEST(PlanarMover, StartsAgainWithinItsLimitsAfterAContact) {
  auto model = std::const_pointer_cast<model::Model>(DiscRobot(0.2));
  model->drive->linear_acceleration = {-1, 1};
  TestWorld world = Empty();
  world.AddRobot("robot", model, PlanarPose(0, 0, 0, 0));
  world.AddBox("wall", {0.1, 4, 1}, 0.75, 0);
  ASSERT_TRUE(world.Start());
  world.Command("robot", {2, 0, 0});
  world.Run(2, 0.01);
  EXPECT_NEAR(world.position("robot").x, 0.5, kGap);
  EXPECT_EQ(world.body("robot").drive.actual.linear, 0);
  world.Command("robot", {-2, 0, 0});
  world.Step(0.01);
  EXPECT_NEAR(world.body("robot").drive.actual.linear, -0.01, 1e-12);
}

TEST(PlanarMover, WheelAnglesEqualTheRolledDistance) {
  auto robot = std::const_pointer_cast<model::Model>(DiscRobot(0.2));
  robot->links.resize(3);
  for (const double side : {1.0, -1.0}) {
    model::Joint joint;
    joint.kind = model::JointKind::kContinuous;
    joint.parent = 0;
    joint.child = side > 0 ? 1 : 2;
    joint.model_from_joint.position = {0, 0.15 * side, 0.05};
    joint.axis = {0, side, 0};  // the right wheel's axis points outwards
    robot->joints.push_back(joint);
  }
  robot->drive->left_wheels = {0};
  robot->drive->right_wheels = {1};
  robot->drive->wheel_separation = 0.3;
  robot->drive->wheel_radius = 0.05;
  TestWorld world = Empty();
  world.AddRobot("robot", robot, PlanarPose(0, 0, 0, 0));
  ASSERT_TRUE(world.Start());
  world.Command("robot", {0.4, 0, 1});
  world.Run(2, 0.01);
  // The left wheel has 0.4 - 0.15 m/s, the right wheel 0.4 + 0.15 m/s.
  EXPECT_NEAR(world.joint("robot", 0), 2 * 0.25 / 0.05, 1e-9);
  EXPECT_NEAR(world.joint("robot", 1), -2 * 0.55 / 0.05, 1e-9);
  EXPECT_NEAR(world.joint_velocity("robot", 0), 0.25 / 0.05, 1e-12);
  EXPECT_NEAR(world.joint_velocity("robot", 1), -0.55 / 0.05, 1e-12);
}

TEST(PlanarMover, OverlapsReturnsTheOverlappingPairs) {
  TestWorld world = Empty();
  world.AddRobot("a", DiscRobot(0.2), PlanarPose(0, 0, 0, 0));
  world.AddRobot("b", DiscRobot(0.2), PlanarPose(0.3, 0, 0, 0));
  world.AddRobot("c", DiscRobot(0.2), PlanarPose(5, 0, 0, 0));
  world.AddBox("wall", {0.1, 4, 1}, 5.1, 0);
  world.AddRobot("touching", DiscRobot(0.25), PlanarPose(-0.45, 0, 0, 0));
  ASSERT_TRUE(world.Start());
  const auto overlaps = world.engine().Overlaps(world.state(), 1e-3);
  ASSERT_EQ(overlaps.size(), 2u);
  EXPECT_EQ(overlaps[0].first, world.layout().Find("a"));
  EXPECT_EQ(overlaps[0].second, world.layout().Find("b"));
  EXPECT_NEAR(overlaps[0].depth, 0.1, 1e-9);
  EXPECT_EQ(overlaps[1].first, world.layout().Find("c"));
  EXPECT_EQ(overlaps[1].second, world.layout().Find("wall"));
  EXPECT_NEAR(overlaps[1].depth, 0.15, 1e-9);
}

TEST(PlanarMover, RobotThatStartsInsideAWallCanLeaveIt) {
  TestWorld world = Empty();
  world.AddRobot("robot", DiscRobot(0.2), PlanarPose(0, 0, 0, 0));
  world.AddBox("wall", {1, 4, 1}, 0.6, 0);  // the robot is 10 cm deep in the wall
  ASSERT_TRUE(world.Start());
  world.Command("robot", {1, 0, 0});
  world.Run(1, 0.01);
  EXPECT_NEAR(world.position("robot").x, 0, kGap);
  world.Command("robot", {-1, 0, 0});
  world.Run(1, 0.01);
  EXPECT_NEAR(world.position("robot").x, -1, kGap);
}

TEST(PlanarMover, ObstacleIsUsedAtItsNewPoseAfterAMove) {
  TestWorld world = Empty();
  world.AddRobot("robot", DiscRobot(0.2), PlanarPose(0, 0, 0, 0));
  auto box = testing::ModelOf(geometry::Box{{0.2, 0.2, 0.2}});
  world.AddRobot("box", box, PlanarPose(1, 0, 0.1, 0));  // a body that is neither static nor driven
  ASSERT_TRUE(world.Start());
  world.Command("robot", {1, 0, 0});
  world.Step(0.01);
  world.body("box").world_from_model.position.x = 2;
  world.Run(4, 0.01);
  EXPECT_NEAR(world.position("robot").x, 2 - 0.1 - 0.2, kGap);
}

TEST(PlanarMover, RejectsAnInvalidDrive) {
  auto robot = std::const_pointer_cast<model::Model>(DiscRobot());
  robot->drive->linear_velocity = {1, -1};
  TestWorld world = Empty();
  world.AddRobot("robot", robot, {});
  const auto status = world.Start();
  ASSERT_FALSE(status);
  EXPECT_EQ(status.error().code, base::ErrorCode::kBadModel);
  EXPECT_EQ(status.error().message, "the drive's linear velocity has min 1 above max -1");
}

}  // namespace
}  // namespace gsv::dynamics
