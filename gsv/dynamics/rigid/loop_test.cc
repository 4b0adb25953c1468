// Tests joints that close loops of links.
#include <cmath>

#include <gtest/gtest.h>

#include "gsv/base/test_within.h"
#include "gsv/dynamics/testing/test_rigid_world.h"

namespace gsv::dynamics {
namespace {

using geometry::Vector3;
using model::JointKind;
using testing::At;
using testing::TestWorld;
using Kind = world::JointCommand::Kind;

// Points of a four-bar linkage in the xz plane. The ground link is A0 B0, the crank A0 A, the
// coupler A B, the rocker B0 B.
constexpr double kGround = 1.0, kCrank = 0.4, kCoupler = 0.9, kRocker = 0.7;

// Returns the rocker's angle above the x axis for the crank's angle, by Freudenstein's equation
// (1954): K1 cos(rocker) - K2 cos(crank) + K3 = cos(crank - rocker). Of its two solutions, this is
// the one with B above the ground link.
double RockerAngle(double crank) {
  const double k1 = kGround / kCrank, k2 = kGround / kRocker;
  const double k3 =
      (kCrank * kCrank - kCoupler * kCoupler + kRocker * kRocker + kGround * kGround) /
      (2 * kCrank * kRocker);
  const double a = std::cos(crank) - k1 - k2 * std::cos(crank) + k3;
  const double b = -2 * std::sin(crank);
  const double c = k1 - (k2 + 1) * std::cos(crank) + k3;
  return 2 * std::atan2(-b - std::sqrt(b * b - 4 * a * c), 2 * a);
}

model::Link BarBetween(const char* name, const Vector3& from, const Vector3& to) {
  const Vector3 along = to - from;
  const double length = Norm(along);
  model::Link bar = testing::LinkOf(geometry::Box{{length, 0.02, 0.02}});
  bar.name = name;
  bar.collisions.clear();
  bar.model_from_link = {(from + to) * 0.5,
                         geometry::FromAxisAngle({0, 1, 0}, -std::atan2(along.z, along.x))};
  bar.inertial.mass = length;
  bar.inertial.ixx = 1e-3;
  bar.inertial.iyy = bar.inertial.izz = length * length * length / 12;
  return bar;
}

model::Joint HingeAt(const char* name, int parent, int child, const Vector3& point) {
  model::Joint joint{name, JointKind::kContinuous, parent, child, {point, {}}};
  joint.axis = {0, -1, 0};  // positive from x to z
  return joint;
}

// A crank, a coupler and a rocker on a base that is fixed to the world. The joint `closing`
// connects the coupler to the rocker.
std::shared_ptr<model::Model> FourBar(double crank_angle, JointKind closing) {
  const double rocker_angle = RockerAngle(crank_angle);
  const Vector3 a0{0, 0, 0}, b0{kGround, 0, 0};
  const Vector3 a{kCrank * std::cos(crank_angle), 0, kCrank * std::sin(crank_angle)};
  const Vector3 b =
      b0 + Vector3{kRocker * std::cos(rocker_angle), 0, kRocker * std::sin(rocker_angle)};
  auto model = testing::SolidOf(geometry::Box{{0.1, 0.1, 0.1}}, 1);
  model->links.push_back(BarBetween("crank", a0, a));
  model->links.push_back(BarBetween("coupler", a, b));
  model->links.push_back(BarBetween("rocker", b0, b));
  model->joints.push_back({"to_world", JointKind::kFixed, -1, 0, {}});
  model->joints.push_back(HingeAt("crank", 0, 1, a0));
  model->joints.push_back(HingeAt("coupler", 1, 2, a));
  model->joints.push_back(HingeAt("rocker", 0, 3, b0));
  model->loop_joints.push_back(HingeAt("closing", 3, 2, b));
  model->loop_joints.back().kind = closing;
  return model;
}

class FourBarLinkage : public ::testing::TestWithParam<JointKind> {};

TEST_P(FourBarLinkage, RockerFollowsFreudensteinsEquation) {
  constexpr double kStart = 0.9;
  TestWorld world(MakeWorldEngine());
  world.AddRigid("linkage", FourBar(kStart, GetParam()), At(0, 0, 2));
  ASSERT_TRUE(world.Start());
  world.CommandJoint("linkage", 1, {Kind::kVelocity, 1.5});
  const double rocker_start = RockerAngle(kStart);
  for (int i = 0; i < 20; ++i) {
    world.Run(0.25, 0.002);
    const double crank = kStart + world.joint("linkage", 1);
    const double rocker = rocker_start + world.joint("linkage", 3);
    EXPECT_WITHIN(rocker, RockerAngle(crank), 2e-3, "rad");
  }
  EXPECT_NEAR(world.joint_velocity("linkage", 1), 1.5, 1e-2);
}

INSTANTIATE_TEST_SUITE_P(Loops, FourBarLinkage,
                         ::testing::Values(JointKind::kContinuous, JointKind::kBall),
                         [](const auto& loop) { return std::string(NameOf(loop.param)); });

// A fixed joint holds the linkage against its weight.
TEST(LoopJoint, FixedLoopJointHoldsAllLinks) {
  TestWorld world(MakeWorldEngine());
  world.AddRigid("linkage", FourBar(0.9, JointKind::kFixed), At(0, 0, 2));
  ASSERT_TRUE(world.Start());
  world.Run(2, 0.002);
  for (int joint : {1, 2, 3}) EXPECT_NEAR(world.joint("linkage", joint), 0, 1e-4);
}

}  // namespace
}  // namespace gsv::dynamics
