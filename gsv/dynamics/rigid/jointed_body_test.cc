// Tests joints and wheels in rigid-body dynamics against closed forms.
#include <utility>

#include <gtest/gtest.h>

#include "gsv/base/test_table.h"
#include "gsv/base/test_within.h"
#include "gsv/dynamics/testing/test_rigid_world.h"
#include "gsv/geometry/constants.h"

namespace gsv::dynamics {
namespace {

using geometry::kPi;
using geometry::Pose;
using testing::At;
using testing::kG;
using testing::TestWorld;
using testing::WorldOnGround;

// One link of 1 kg that hangs from the world. Its centre is `length` below its joint. The joint's
// axis is y.
std::shared_ptr<model::Model> Hanging(model::JointKind kind, double length,
                                      const geometry::Vector3& axis = {0, 1, 0}) {
  auto model = testing::ModelOf(geometry::Sphere{0.01}, At(0, 0, -length));
  model->links[0].inertial.link_from_com = At(0, 0, -length);
  model->links[0].inertial.ixx = model->links[0].inertial.iyy = model->links[0].inertial.izz = 1e-4;
  model::Joint joint;
  joint.name = "joint";
  joint.kind = kind;
  joint.axis = axis;
  model->joints.push_back(joint);
  return model;
}

constexpr double kPendulum = 0.5;  // m

// Returns the mean period of ten swings from rest at an angle, and the largest angle to which the
// pendulum returns.
double PeriodOf(double amplitude, double& highest) {
  TestWorld world(MakeWorldEngine());
  world.AddRigid("pendulum", Hanging(model::JointKind::kRevolute, kPendulum), At(0, 0, 2));
  EXPECT_TRUE(world.Start());
  world.state().joint_positions[0] = amplitude;
  // A swing begins when the rate changes from positive to negative.
  int swings = 0;
  double begun = 0, ended = 0, before = 0;
  for (int i = 1; swings < 11 && i < 50000; ++i) {
    before = world.joint_velocity("pendulum", 0);
    world.Step(0.001);
    const double now = world.joint_velocity("pendulum", 0);
    highest = std::max(highest, world.joint("pendulum", 0));
    if (!(before > 0 && now <= 0)) continue;
    const double time = 0.001 * (i - now / (now - before));
    if (swings++ == 0) begun = time;
    ended = time;
  }
  return (ended - begun) / 10;
}

TEST(JointedBody, PendulumHasItsClosedFormPeriod) {
  base::testing::Table table("pendulum");
  const double inertia = 1e-4 + kPendulum * kPendulum;
  for (const double amplitude : {0.05, 0.3, 0.6, 1.0, 1.5, 2.0, 2.5}) {
    // T = 2 pi sqrt(I / (m g l)) 2/pi K(sin(a / 2)), K by the arithmetic-geometric mean.
    double a = 1, g = std::cos(amplitude / 2);
    for (int i = 0; i < 8; ++i) a = std::exchange(g, std::sqrt(a * g)) / 2 + a / 2;
    const double expected = 2 * kPi * std::sqrt(inertia / (kG * kPendulum)) / a;
    double highest = 0;
    const double period = PeriodOf(amplitude, highest);
    EXPECT_WITHIN_PERCENT(period, expected, 0.1) << amplitude;
    EXPECT_WITHIN(highest, amplitude, 0.002, "rad") << amplitude;
    table.Row({amplitude, period, expected});
  }
}

TEST(JointedBody, ALimitStopsAJoint) {
  auto model = Hanging(model::JointKind::kPrismatic, 0, {0, 0, 1});
  model->joints[0].position_limits = {-0.4, 0.2};
  TestWorld world(MakeWorldEngine());
  world.AddRigid("slider", model, At(0, 0, 5));
  ASSERT_TRUE(world.Start());
  world.Run(2, 0.01);
  EXPECT_WITHIN(world.joint("slider", 0), -0.4, 1e-3, "m");
  EXPECT_NEAR(world.joint_velocity("slider", 0), 0, 1e-6);
}

TEST(JointedBody, DampedLinkSinksAtItsTerminalSpeed) {
  auto model = Hanging(model::JointKind::kPrismatic, 0, {0, 0, 1});
  model->joints[0].damping = 20;
  TestWorld world(MakeWorldEngine());
  world.AddRigid("slider", model, At(0, 0, 50));
  ASSERT_TRUE(world.Start());
  world.Run(2, 0.01);
  EXPECT_WITHIN_PERCENT(world.joint_velocity("slider", 0), -kG / 20, 3);
}

TEST(JointedBody, DampingLimitsTheRateOfAJointWithALightLink) {
  for (const double inertia : {1e-6, 1e-4, 1e-3, 0.1}) {
    auto model = Hanging(model::JointKind::kContinuous, 0, {0, 0, 1});
    model->links[0].inertial.ixx = model->links[0].inertial.iyy = model->links[0].inertial.izz =
        inertia;
    model->joints[0].damping = 1;
    TestWorld world(MakeWorldEngine());
    world.AddRigid("rotor", model, At(0, 0, 2));
    ASSERT_TRUE(world.Start());
    world.CommandJoint("rotor", 0, {world::JointCommand::Kind::kEffort, 1});
    world.Run(2, 0.01);
    EXPECT_WITHIN_PERCENT(world.joint_velocity("rotor", 0), 1, 0.01) << inertia;
  }
}

TEST(JointedBody, JointRespectsItsVelocityLimitUnderAnyEffort) {
  auto model = Hanging(model::JointKind::kContinuous, 0, {0, 0, 1});
  model->joints[0].velocity_limit = 0.5;
  TestWorld world(MakeWorldEngine());
  world.AddRigid("rotor", model, At(0, 0, 2));
  ASSERT_TRUE(world.Start());
  for (const double effort : {1.0, 100.0, -100.0}) {
    world.CommandJoint("rotor", 0, {world::JointCommand::Kind::kEffort, effort});
    for (int i = 0; i < 20; ++i) {
      world.Step(0.01);
      ASSERT_WITHIN(std::abs(world.joint_velocity("rotor", 0)), 0.5, 1e-6, "rad/s") << effort;
    }
  }
}

TEST(JointedBody, FallingLinkRespectsItsVelocityLimit) {
  auto model = Hanging(model::JointKind::kPrismatic, 0, {0, 0, 1});
  model->joints[0].velocity_limit = 0.3;
  TestWorld world(MakeWorldEngine());
  world.AddRigid("slider", model, At(0, 0, 5));
  ASSERT_TRUE(world.Start());
  world.Run(1, 0.01);
  EXPECT_WITHIN(world.joint_velocity("slider", 0), -0.3, 1e-6, "m/s");
}

TEST(JointedBody, FrictionHoldsAJoint) {
  auto model = Hanging(model::JointKind::kPrismatic, 0, {0, 0, 1});
  model->joints[0].friction = 9.9;  // N, more than the link's weight of 9.8 N
  TestWorld world(MakeWorldEngine());
  world.AddRigid("slider", model, At(0, 0, 5));
  ASSERT_TRUE(world.Start());
  world.Run(1, 0.01);
  EXPECT_WITHIN(world.joint("slider", 0), 0, 1e-6, "m");
}

TEST(JointedBody, FrictionSlowsDownAMotorOfLimitedEffort) {
  using Kind = world::JointCommand::Kind;
  constexpr double kEffort = 3, kTime = 0.1;
  for (const double friction : {0.0, 1.0, 5.0}) {
    auto model = Hanging(model::JointKind::kPrismatic, 0, {1, 0, 0});
    model->joints[0].friction = friction;
    model->joints[0].effort_limit = kEffort;
    const double mass = model->links[0].inertial.mass;
    TestWorld world(MakeWorldEngine());
    world.AddRigid("slider", model, At(0, 0, 5));
    ASSERT_TRUE(world.Start());
    world.CommandJoint("slider", 0, {Kind::kVelocity, 100});
    world.Run(kTime, 0.001);
    const double expected = std::max(0.0, kEffort - friction) / mass * kTime;
    EXPECT_WITHIN(world.joint_velocity("slider", 0), expected, 1e-6, "m/s") << friction;
  }
}

TEST(JointedBody, JointReachesItsCommandedPosition) {
  using Kind = world::JointCommand::Kind;
  TestWorld world(MakeWorldEngine());
  world.AddRigid("arm", Hanging(model::JointKind::kRevolute, 0.5), At(0, 0, 2));
  ASSERT_TRUE(world.Start());
  world.CommandJoint("arm", 0, {Kind::kPosition, 1.2});
  world.Run(1, 0.01);
  EXPECT_WITHIN(world.joint("arm", 0), 1.2, 1e-3, "rad");
  const double before = world.joint("arm", 0);
  world.CommandJoint("arm", 0, {Kind::kVelocity, -0.5});
  world.Run(1, 0.01);
  EXPECT_WITHIN(world.joint("arm", 0), before - 0.5, 1e-3, "rad");
  EXPECT_WITHIN(world.joint_velocity("arm", 0), -0.5, 1e-6, "rad/s");
}

TEST(JointedBody, AnEffortAcceleratesAJointUpToItsLimit) {
  auto model = Hanging(model::JointKind::kPrismatic, 0, {1, 0, 0});
  model->joints[0].effort_limit = 3;
  TestWorld world(MakeWorldEngine());
  world.AddRigid("slider", model, At(0, 0, 2));
  ASSERT_TRUE(world.Start());
  world.CommandJoint("slider", 0, {world::JointCommand::Kind::kEffort, 2});
  world.Run(1, 0.01);
  EXPECT_WITHIN(world.joint_velocity("slider", 0), 2, 1e-6, "m/s");
  world.CommandJoint("slider", 0, {world::JointCommand::Kind::kEffort, 50});
  world.Run(1, 0.01);
  EXPECT_WITHIN(world.joint_velocity("slider", 0), 2 + 3, 1e-6, "m/s");
}

// A box of 8 kg on two wheels and, behind them, a ball that slides, as small robots are built.
std::shared_ptr<model::Model> WheeledRobot() {
  auto model = std::make_shared<model::Model>();
  model->name = "robot";
  model::Link base;
  base.name = "base";
  base.model_from_link = At(0, 0, 0.1);
  base.inertial = {8, At(-0.04, 0, 0), 0.06, 0.1, 0.15};
  base.collisions.push_back({"box", {}, geometry::Box{{0.4, 0.24, 0.1}}, {}});
  base.collisions.push_back({"caster", At(-0.15, 0, -0.07), geometry::Sphere{0.03}, {0, 0, 0}});
  model->links.push_back(base);
  const geometry::Quaternion lying = geometry::FromAxisAngle({1, 0, 0}, -kPi / 2);
  for (const double side : {1.0, -1.0}) {
    model::Link wheel;
    wheel.name = side > 0 ? "left" : "right";
    wheel.model_from_link = {{0, side * 0.15, 0.1}, lying};
    wheel.inertial = {0.5, {}, 0.0014, 0.0014, 0.0025};
    wheel.collisions.push_back({"tyre", {}, geometry::Cylinder{0.1, 0.02}, {1, 1, 0}});
    model->links.push_back(wheel);
    model::Joint joint;
    joint.name = wheel.name + "_joint";
    joint.kind = model::JointKind::kContinuous;
    joint.parent = 0;
    joint.child = static_cast<int>(model->links.size()) - 1;
    joint.model_from_joint = At(0, side * 0.15, 0.1);
    joint.axis = {0, 1, 0};
    model->joints.push_back(joint);
  }
  model->drive = model::Drive{};
  model->drive->left_wheels = {0};
  model->drive->right_wheels = {1};
  model->drive->wheel_separation = 0.3;
  model->drive->wheel_radius = 0.1;
  model->drive->linear_acceleration = {-1, 1};
  model->movement = model::Movement::kRigid;
  return model;
}

TEST(JointedBody, RobotRollsTheDistanceOfItsWheels) {
  TestWorld world = WorldOnGround();
  world.AddRigid("robot", WheeledRobot(), {});
  ASSERT_TRUE(world.Start());
  world.Command("robot", {0.5, 0, 0});
  world.Run(4.5, 0.01);
  // Half a second of acceleration (0.125 m), then 4 s at 0.5 m/s.
  EXPECT_WITHIN(world.position("robot").x, 2.125, 0.005, "m");
  EXPECT_NEAR(world.position("robot").y, 0, 0.001);
  EXPECT_NEAR(world.position("robot").z, 0, 1e-3);
  EXPECT_WITHIN(world.joint("robot", 0) * 0.1, world.position("robot").x, 0.005, "m");
  EXPECT_NEAR(world.body("robot").drive.actual.linear, 0.5, 1e-9);
}

TEST(JointedBody, RobotTurnsByTheDifferenceOfItsWheels) {
  TestWorld world = WorldOnGround();
  world.AddRigid("robot", WheeledRobot(), {});
  ASSERT_TRUE(world.Start());
  world.Command("robot", {0, 0, 1});
  world.Run(1.5, 0.01);
  // The robot's tyres are 2 cm wide and slip sideways. The friction may act anywhere within this
  // width, 14 to 16 cm from the centre of the robot.
  EXPECT_WITHIN_PERCENT(world.yaw("robot"), 1.5, 100 * (1 - 0.15 / 0.16));
  EXPECT_NEAR(world.position("robot").x, 0, 0.02);
  EXPECT_NEAR(world.position("robot").y, 0, 0.02);
}

TEST(JointedBody, SlidingDownASlopeDoesNotRotateTheWheels) {
  const double angle = 0.2, mu = 0.1;
  const Pose incline{{0, 0, 0}, geometry::FromAxisAngle({0, 1, 0}, angle)};
  TestWorld world(MakeWorldEngine());
  world.AddStatic("incline", testing::GroundOf({mu, mu, 0}), incline);
  world.AddRigid("robot", WheeledRobot(), incline);
  ASSERT_TRUE(world.Start());
  world.Run(2, 0.01);
  // The wheels are blocked. The share of the weight that they carry depends on how the weight
  // shifts. So the distance is between that of a body without friction and that of a body with all
  // its weight on the wheels.
  const double slid = (Inverse(incline) * world.position("robot")).x;
  EXPECT_GT(slid, 0.95 * kG * (std::sin(angle) - mu * std::cos(angle)) * 2);
  EXPECT_LT(slid, kG * std::sin(angle) * 2);
  EXPECT_NEAR(world.joint("robot", 0), 0, 1e-6);
}

TEST(JointedBody, RobotClimbsARampThatStopsAPlanarRobot) {
  TestWorld world = WorldOnGround();
  // The ramp's upper face starts on the ground at x = 1 and has a slope of 1 : 5.
  const double slope = std::atan(0.2);
  const geometry::Quaternion up = geometry::FromAxisAngle({0, 1, 0}, -slope);
  world.AddStatic("ramp", testing::ModelOf(geometry::Box{{4, 3, 0.2}}),
                  {geometry::Vector3{1, 0, 0} + up * geometry::Vector3{2, 0, -0.1}, up});
  world.AddRigid("robot", WheeledRobot(), {});
  ASSERT_TRUE(world.Start());
  world.Command("robot", {0.5, 0, 0});
  world.Run(6, 0.01);
  EXPECT_GT(world.position("robot").x, 2);
  EXPECT_WITHIN(world.position("robot").z, 0.2 * (world.position("robot").x - 1), 0.03, "m");
}

TEST(JointedBody, RunIsRepeatableFromAnyState) {
  const auto make = [] {
    TestWorld world = WorldOnGround();
    world.AddRigid("robot", WheeledRobot(), At(0, 0, 0));
    world.AddRigid("box", testing::SolidOf(geometry::Box{{0.2, 0.2, 0.2}}, 1), At(0.6, 0, 0.1));
    EXPECT_TRUE(world.Start());
    world.Command("robot", {0.5, 0, 0.2});
    return world;
  };
  TestWorld lived = make(), fresh = make();
  lived.Run(1, 0.01);
  fresh.state() = lived.state();
  lived.Run(1, 0.01);
  fresh.Run(1, 0.01);
  EXPECT_EQ(lived.Digest(), fresh.Digest());
  EXPECT_GT(lived.position("box").x, 0.7);
}

}  // namespace
}  // namespace gsv::dynamics
