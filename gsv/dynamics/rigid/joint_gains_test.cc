// Tests joints that follow their commands by the gains of a controller, against the linear
// equations of motion.
#include <gtest/gtest.h>

#include "gsv/base/test_within.h"
#include "gsv/dynamics/testing/test_rigid_world.h"

namespace gsv::dynamics {
namespace {

using geometry::Pose;
using geometry::Vector3;
using testing::At;
using testing::kG;
using testing::SolidOf;
using testing::TestWorld;
using testing::WorldOnGround;

using world::JointCommand;

constexpr double kMass = 2;    // kg
constexpr double kRest = 0.1;  // m/s²: a body that accelerates by less is at rest

// Returns a sphere on a slider along x, or along z.
std::shared_ptr<model::Model> Slider(const Vector3& axis) {
  auto model = SolidOf(geometry::Sphere{0.05}, kMass);
  model::Joint joint;
  joint.name = "slider";
  joint.kind = model::JointKind::kPrismatic;
  joint.axis = axis;
  model->joints.push_back(joint);
  return model;
}

TestWorld WorldOf(std::shared_ptr<model::Model> model) {
  TestWorld world(MakeWorldEngine());
  world.AddRigid("slider", std::move(model), At(0, 0, 2));
  EXPECT_TRUE(world.Start());
  return world;
}

TEST(JointGains, PositionFollowsTheResponseOfASecondOrderSystem) {
  for (const double damping_ratio : {0.2, 0.5, 0.8}) {
    const double frequency = 10, target = 0.1;
    auto model = Slider({1, 0, 0});
    model->joints[0].position_gains = {kMass * frequency * frequency, 0,
                                       2 * damping_ratio * frequency * kMass};
    TestWorld world = WorldOf(model);
    world.CommandJoint("slider", 0, {JointCommand::Kind::kPosition, target});
    const double damped = frequency * std::sqrt(1 - damping_ratio * damping_ratio);
    for (int i = 1; i <= 1000; ++i) {
      world.Step(0.001);
      const double t = 0.001 * i, decay = std::exp(-damping_ratio * frequency * t);
      const double expected =
          target * (1 - decay * (std::cos(damped * t) +
                                 damping_ratio * frequency / damped * std::sin(damped * t)));
      ASSERT_WITHIN(world.joint("slider", 0), expected, 1e-3, "m") << damping_ratio << " at " << t;
    }
  }
}

// A body without contacts and friction never counts as at rest. So even a torque that accelerates
// it by less than kResting (moving_body.h) moves it.
TEST(JointGains, SmallTorqueTurnsAFrictionlessHinge) {
  const double torque = 0.01, inertia = 0.182, seconds = 10;  // N m, kg m², s
  auto model = Slider({0, 0, 1});
  model->joints[0].kind = model::JointKind::kContinuous;
  model->links[0].inertial.izz = inertia;
  model->links[0].has_gravity = false;
  for (const double step : {0.001, 0.01}) {
    TestWorld world = WorldOf(model);
    world.CommandJoint("slider", 0, {JointCommand::Kind::kEffort, torque});
    world.Run(seconds, step);
    const double acceleration = torque / inertia;
    EXPECT_WITHIN(world.joint("slider", 0), acceleration * seconds * seconds / 2,
                  acceleration * seconds * step, "rad")
        << step;
  }
}

TEST(JointGains, LoadDisplacesAJointByItsWeightOverTheGain) {
  auto model = Slider({0, 0, 1});
  model->joints[0].position_gains = {400, 0, 60};
  TestWorld world = WorldOf(model);
  world.CommandJoint("slider", 0, {JointCommand::Kind::kPosition, 0.3});
  world.Run(5, 0.001);
  EXPECT_WITHIN(world.joint("slider", 0), 0.3 - kMass * kG / 400, kMass * kRest / 400, "m");
}

TEST(JointGains, IntegralTermCarriesTheLoad) {
  auto model = Slider({0, 0, 1});
  model->joints[0].position_gains = {400, 400, 60, {-100, 100}};
  for (const double step : {0.001, 0.01}) {
    TestWorld world = WorldOf(model);
    world.CommandJoint("slider", 0, {JointCommand::Kind::kPosition, 0.3});
    world.Run(15, step);
    EXPECT_WITHIN(world.joint("slider", 0), 0.3, kMass * kRest / 400, "m") << step;
    EXPECT_WITHIN(world.state().joint_integrals.at(0), kMass * kG, kMass * kRest, "N") << step;
  }
}

TEST(JointGains, LimitOfTheIntegralTermIsKept) {
  auto model = Slider({0, 0, 1});
  model->joints[0].position_gains = {400, 400, 60, {-5, 5}};
  TestWorld world = WorldOf(model);
  world.CommandJoint("slider", 0, {JointCommand::Kind::kPosition, 0.3});
  world.Run(10, 0.001);
  EXPECT_WITHIN(world.joint("slider", 0), 0.3 - (kMass * kG - 5) / 400, kMass * kRest / 400, "m");
}

TEST(JointGains, EffortIsLimitedByTheControllerAndTheJoint) {
  for (const bool by_joint : {false, true}) {
    auto model = Slider({1, 0, 0});
    model->joints[0].position_gains = {1e4, 0, 1};
    if (by_joint) {
      model->joints[0].effort_limit = 3;
    } else {
      model->joints[0].position_gains->effort = {-3, 3};
    }
    TestWorld world = WorldOf(model);
    world.CommandJoint("slider", 0, {JointCommand::Kind::kPosition, 10});
    world.Run(1, 0.001);
    EXPECT_WITHIN_PERCENT(world.joint_velocity("slider", 0), 3 / kMass, 0.1);
  }
}

TEST(JointGains, VelocityFollowsTheResponseOfAFirstOrderSystem) {
  auto model = Slider({1, 0, 0});
  model->joints[0].velocity_gains = {20, 0, 0};
  TestWorld world = WorldOf(model);
  world.CommandJoint("slider", 0, {JointCommand::Kind::kVelocity, 0.5});
  for (int i = 1; i <= 500; ++i) {
    world.Step(0.001);
    const double expected = 0.5 * (1 - std::exp(-20 / kMass * 0.001 * i));
    ASSERT_WITHIN(world.joint_velocity("slider", 0), expected, 2e-3, "m/s") << i;
  }
}

// An explicit integration with a step of 1 ms would be unstable with these gains.
TEST(JointGains, StiffControllerOfALightLinkIsStable) {
  auto model = Slider({1, 0, 0});
  model->links[0].inertial.mass = 1e-3;
  model->joints[0].position_gains = {1e5, 0, 0};
  TestWorld world = WorldOf(model);
  world.CommandJoint("slider", 0, {JointCommand::Kind::kPosition, 0.1});
  world.Run(0.5, 0.001);
  EXPECT_WITHIN(world.joint("slider", 0), 0.1, 1e-6, "m");
}

TEST(JointGains, StepDependsOnTheStateAlone) {
  auto model = Slider({0, 0, 1});
  model->joints[0].position_gains = {400, 400, 60, {-100, 100}};
  TestWorld first = WorldOf(model), second = WorldOf(model);
  first.CommandJoint("slider", 0, {JointCommand::Kind::kPosition, 0.3});
  first.Run(0.3, 0.001);
  second.state() = first.state();
  EXPECT_EQ(first.Digest(), second.Digest());
  first.Run(0.3, 0.001);
  second.Run(0.3, 0.001);
  EXPECT_EQ(first.Digest(), second.Digest());
  second.state().joint_integrals[0] += 1;
  EXPECT_NE(first.Digest(), second.Digest());
}

}  // namespace
}  // namespace gsv::dynamics
