// Tests mimic joints, which follow another joint, in rigid-body dynamics and in planar kinematics.
#include <gtest/gtest.h>

#include "gsv/base/test_within.h"
#include "gsv/dynamics/testing/test_rigid_world.h"

namespace gsv::dynamics {
namespace {

using testing::At;
using testing::TestWorld;
using Kind = world::JointCommand::Kind;

// A base with two fingers. The second finger follows the first.
std::shared_ptr<model::Model> Fingers(const model::Mimic& mimic) {
  auto model = testing::SolidOf(geometry::Box{{0.2, 0.2, 0.2}}, 1);
  for (const double side : {1.0, -1.0}) {
    model::Link finger = testing::LinkOf(geometry::Box{{0.1, 0.02, 0.02}});
    finger.name = side > 0 ? "left" : "right";
    finger.model_from_link = At(0.3, 0.1 * side, 0);
    finger.inertial.mass = 0.1;
    finger.inertial.ixx = finger.inertial.iyy = finger.inertial.izz = 1e-4;
    model->links.push_back(finger);
  }
  model->joints.push_back({"to_world", model::JointKind::kFixed, -1, 0, {}});
  for (int finger = 1; finger <= 2; ++finger) {
    model::Joint joint{finger == 1 ? "leader" : "follower", model::JointKind::kRevolute, 0, finger,
                       model->links[static_cast<std::size_t>(finger)].model_from_link};
    joint.position_limits = {-3, 3};
    model->joints.push_back(joint);
  }
  model->joints[2].mimic = mimic;
  return model;
}

// A robot with the same fingers, whose base is not fixed.
std::shared_ptr<model::Model> PlanarFingers(const model::Mimic& mimic) {
  auto model = Fingers(mimic);
  model->joints.erase(model->joints.begin());
  model->joints[1].mimic->leader = 0;
  model->drive = model::Drive{};
  return model;
}

TEST(Mimic, AJointFollowsItsLeader) {
  TestWorld world(MakeWorldEngine());
  world.AddRigid("gripper", Fingers({1, -1.5, 0.2, 0.1}), At(0, 0, 1));
  ASSERT_TRUE(world.Start());
  world.Run(2, 0.002);
  EXPECT_NEAR(world.joint("gripper", 2), 0.2 - 1.5 * (world.joint("gripper", 1) - 0.1), 2e-3);
  world.CommandJoint("gripper", 1, {Kind::kPosition, 0.8});
  world.Run(3, 0.002);
  EXPECT_NEAR(world.joint("gripper", 1), 0.8, 2e-3);
  EXPECT_NEAR(world.joint("gripper", 2), -1.5 * (0.8 - 0.1) + 0.2, 5e-3);
}

// If the leader moves at a constant rate, its follower moves at this rate times the multiplier (2).
TEST(Mimic, AJointMovesAtItsLeadersRate) {
  TestWorld world(MakeWorldEngine());
  world.AddRigid("gripper", Fingers({1, 2, 0, 0}), At(0, 0, 1));
  ASSERT_TRUE(world.Start());
  world.CommandJoint("gripper", 1, {Kind::kVelocity, 0.3});
  world.Run(2, 0.002);
  EXPECT_NEAR(world.joint_velocity("gripper", 2), 0.6, 1e-3);
  EXPECT_NEAR(world.joint("gripper", 2), 2 * world.joint("gripper", 1), 5e-3);
}

// A gear with the ratio n. The leader accelerates its own inertia I1 and n² times the inertia I2 of
// the follower. So a torque t accelerates the leader by t / (I1 + n² I2).
TEST(Mimic, LeaderAcceleratesTheInertiaOfItsFollower) {
  auto model = Fingers({1, -3, 0, 0});
  for (model::Link& link : model->links) link.has_gravity = false;
  for (model::Joint& joint : model->joints) joint.position_limits = {};
  for (std::size_t finger : {1, 2}) {
    model->joints[finger].axis = {1, 0, 0};
    model->links[finger].inertial.ixx = finger == 1 ? 2e-4 : 5e-4;
  }
  TestWorld world(MakeWorldEngine());
  world.AddRigid("gearbox", model, At(0, 0, 1));
  ASSERT_TRUE(world.Start());
  world.CommandJoint("gearbox", 1, {Kind::kEffort, 0.01});
  world.Run(0.5, 0.001);
  const double rate = 0.01 / (2e-4 + 9 * 5e-4) * 0.5;
  EXPECT_WITHIN_PERCENT(world.joint_velocity("gearbox", 1), rate, 1);
  EXPECT_WITHIN_PERCENT(world.joint_velocity("gearbox", 2), -3 * rate, 1);
}

TEST(Mimic, AJointOfAPlanarRobotFollowsItsLeader) {
  auto model = PlanarFingers({1, -1, 0, 0});
  TestWorld world(MakeWorldEngine());
  world.AddRobot("robot", model, {});
  ASSERT_TRUE(world.Start());
  world.CommandJoint("robot", 0, {Kind::kPosition, 0.4});
  world.Run(0.5, 0.01);
  EXPECT_NEAR(world.joint("robot", 0), 0.4, 1e-12);
  EXPECT_NEAR(world.joint("robot", 1), -0.4, 1e-12);
}

TEST(Mimic, AJointOfAPlanarRobotFollowsItsLeaderWithoutACommand) {
  auto model = PlanarFingers({.multiplier = -1, .offset = 0.3});
  TestWorld world(MakeWorldEngine());
  world.AddRobot("robot", model, {});
  ASSERT_TRUE(world.Start());
  world.state().joint_positions[0] = 0.1;
  world.Run(0.1, 0.01);
  EXPECT_NEAR(world.joint("robot", 1), 0.2, 1e-12);
}

TEST(Mimic, MimicJointRejectsCommands) {
  TestWorld world(MakeWorldEngine());
  world.AddRigid("gripper", Fingers({1, 1, 0, 0}), At(0, 0, 1));
  ASSERT_TRUE(world.Start());
  const world::Body& body = world.layout().bodies[0];
  EXPECT_TRUE(world::CheckJointCommand(body, 1, {Kind::kPosition, 1}));
  const auto refused = world::CheckJointCommand(body, 2, {Kind::kPosition, 1});
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().Sentence().find("follows leader"), std::string::npos);
}

}  // namespace
}  // namespace gsv::dynamics
