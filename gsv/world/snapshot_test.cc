#include "gsv/world/snapshot.h"

#include <gtest/gtest.h>

#include "gsv/geometry/constants.h"

namespace gsv::world {
namespace {

using geometry::Pose;
using geometry::Vector3;

using geometry::kPi;

// A mast that rotates about z at (1, 0, 0). It carries a prismatic joint along the mast's x axis.
// This joint carries a hand at (2, 0, 0).
model::Model Arm() {
  model::Model arm;
  arm.links.resize(3);
  arm.links[1].model_from_link.position = {1, 0, 0};
  arm.links[2].model_from_link.position = {2, 0, 0};
  model::Joint turn;
  turn.kind = model::JointKind::kRevolute;
  turn.parent = 0, turn.child = 1;
  turn.model_from_joint.position = {1, 0, 0};
  model::Joint slide;
  slide.kind = model::JointKind::kPrismatic;
  slide.parent = 1, slide.child = 2;
  slide.model_from_joint.position = {2, 0, 0};
  slide.axis = {1, 0, 0};
  arm.joints = {turn, slide};
  return arm;
}

void ExpectNear(const Vector3& a, const Vector3& b) {
  EXPECT_NEAR(a.x, b.x, 1e-12);
  EXPECT_NEAR(a.y, b.y, 1e-12);
  EXPECT_NEAR(a.z, b.z, 1e-12);
}

TEST(LinkPoses, AtZeroJointPositionsAreThoseOfTheModel) {
  const auto poses = LinkPoses(Arm(), std::vector<double>{0, 0});
  ExpectNear(poses[1].position, {1, 0, 0});
  ExpectNear(poses[2].position, {2, 0, 0});
}

TEST(LinkPoses, ChildLinkFollowsItsParentsJoint) {
  // Rotated by 90°, the hand is at (1, 1, 0). Moved out by 0.5 along the rotated axis, it is at (1,
  // 1.5, 0).
  const auto poses = LinkPoses(Arm(), std::vector<double>{kPi / 2, 0.5});
  ExpectNear(poses[1].position, {1, 0, 0});
  ExpectNear(poses[2].position, {1, 1.5, 0});
  ExpectNear(poses[2].orientation * Vector3{1, 0, 0}, {0, 1, 0});
}

TEST(LinkPose, AgreesWithLinkPosesInTheWorld) {
  auto description = std::make_shared<model::WorldDescription>();
  Body body;
  body.name = "arm";
  body.model = std::make_shared<model::Model>(Arm());
  body.initial_pose = geometry::PlanarPose(10, 0, 0, kPi);
  Snapshot snapshot;
  snapshot.layout = MakeLayout(1, {body}, description);
  snapshot.state = InitialState(*snapshot.layout);
  snapshot.state.joint_positions = {kPi / 2, 0.5};
  ExpectNear(LinkPose(snapshot, 0, 2).position, {9, -1.5, 0});
  // The two functions multiply in different orders, so they are equal only up to rounding.
  ExpectNear(LinkPose(snapshot, 0, 2).position, LinkPoses(snapshot, 0)[2].position);
}

TEST(Contacts, ClosingSpeedIsThatOfTheContactPoint) {
  // One body moves along x at 2 m/s and rotates at 3 rad/s about z. The other body moves in the
  // same direction at 0.5 m/s.
  State state;
  state.bodies.resize(2);
  state.bodies[0].world_from_model.position = {1, 0, 0};
  state.bodies[0].linear_velocity = {2, 0, 0};
  state.bodies[0].angular_velocity = {0, 0, 3};
  state.bodies[1].world_from_model.position = {3, 0, 0};
  state.bodies[1].linear_velocity = {0.5, 0, 0};
  std::vector<Acceleration> kept;
  std::vector<double> joints;
  KeepVelocities(state, kept, joints);
  state.bodies[0].linear_velocity = {};  // the contact has stopped the body
  // The contact is 0.4 m to the right of the first body's centre. There, the rotation of this body
  // adds 1.2 m/s.
  std::vector<Contact> contacts(3, {0, 1, {2, -0.4, 0}, {1, 0, 0}, 0.01, true});
  contacts[1].began = false;
  contacts[2].normal = {-1, 0, 0};
  FinishContacts(state, kept, contacts);
  EXPECT_NEAR(contacts[0].closing_speed, 2 + 1.2 - 0.5, 1e-12);
  EXPECT_EQ(contacts[1].closing_speed, 0);  // these bodies already touched before
  EXPECT_EQ(contacts[2].closing_speed, 0);  // these bodies move away from each other
}

TEST(Snapshot, AccelerationsAreTheMeansOfAStep) {
  State state;
  state.bodies.resize(1);
  state.bodies[0].linear_velocity = {1, 0, 0};
  state.joint_velocities = {2, -1};
  std::vector<Acceleration> bodies;
  std::vector<double> joints;
  KeepVelocities(state, bodies, joints);
  state.bodies[0].linear_velocity = {1.5, 0, 0};
  state.joint_velocities = {2, -4};
  FinishAccelerations(state, 0.1, bodies, joints);
  EXPECT_NEAR(bodies[0].linear.x, 5, 1e-12);
  EXPECT_EQ(joints[0], 0);
  EXPECT_NEAR(joints[1], -30, 1e-12);
}

TEST(MovingLinks, AreLinksBelowAMovingJoint) {
  model::Model arm = Arm();
  EXPECT_EQ(MovingLinks(arm), (std::vector<int>{1, 2}));
  arm.joints[0].kind = model::JointKind::kFixed;
  EXPECT_EQ(MovingLinks(arm), (std::vector<int>{2}));
}

}  // namespace
}  // namespace gsv::world
