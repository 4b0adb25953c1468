// Tests wind, fluids, the decay of velocities, and kinematic links. Every expected value is a
// closed form.
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "gsv/dynamics/testing/test_rigid_world.h"

namespace gsv::dynamics {
namespace {

using geometry::Vector3;
using std::numbers::pi;
using testing::At;
using testing::kG;
using testing::SolidOf;
using testing::TestWorld;
using testing::WorldOnGround;

constexpr double kMediumStep = 0.001;

std::shared_ptr<model::Model> Cube(double mass) {
  return SolidOf(geometry::Box{{0.2, 0.2, 0.2}}, mass);
}

// Without gravity, v = v0 (1 - k)^(t/h). h is the world's step, as in SDFormat's definition of the
// decay.
TEST(VelocityDecay, ReducesTheVelocityInEachStepOfTheWorld) {
  for (const double step : {0.001, 0.004}) {
    TestWorld world(MakeWorldEngine());
    world.description().gravity = {};
    world.description().max_step_size = std::chrono::milliseconds(4);
    auto model = Cube(2);
    model->links[0].linear_decay = 0.01;
    model->links[0].angular_decay = 0.02;
    world.AddRigid("box", model, At(0, 0, 1));
    ASSERT_TRUE(world.Start());
    world.body("box").linear_velocity = {3, 0, 0};
    world.body("box").angular_velocity = {0, 0, 5};
    world.Run(0.4, step);
    EXPECT_NEAR(world.body("box").linear_velocity.x, 3 * std::pow(0.99, 100), 1e-9) << step;
    EXPECT_NEAR(world.body("box").angular_velocity.z, 5 * std::pow(0.98, 100), 1e-9) << step;
  }
}

// At the terminal velocity, gravity adds in a step the velocity that the decay removes.
TEST(VelocityDecay, EndsAFallAtItsTerminalVelocity) {
  TestWorld world(MakeWorldEngine());
  auto model = Cube(2);
  model->links[0].linear_decay = 0.01;
  world.AddRigid("box", model, At(0, 0, 1));
  ASSERT_TRUE(world.Start());
  world.Run(5, kMediumStep);
  EXPECT_NEAR(world.body("box").linear_velocity.z, -kG * kMediumStep / 0.01, 1e-6);
}

// Two links with a fixed joint: each loses its own fraction of its momentum.
TEST(VelocityDecay, OfFixedLinksIsWeightedByTheirMass) {
  TestWorld world(MakeWorldEngine());
  world.description().gravity = {};
  auto model = Cube(3);
  model->links.push_back(model->links[0]);
  model->links[1].name = "second";
  model->links[1].inertial.mass = 1;
  model->links[1].linear_decay = 0.04;
  model->joints.push_back({"fixed", model::JointKind::kFixed, 0, 1, {}});
  world.AddRigid("box", model, At(0, 0, 1));
  ASSERT_TRUE(world.Start());
  world.body("box").linear_velocity = {1, 0, 0};
  world.Run(0.1, kMediumStep);
  EXPECT_NEAR(world.body("box").linear_velocity.x, std::pow(0.99, 100), 1e-9);
}

// v' = d (w - v): v = w (1 - exp(-d t)).
TEST(Wind, ForceIsProportionalToTheRelativeVelocity) {
  TestWorld world(MakeWorldEngine());
  world.description().gravity = {};
  world.description().wind = model::Wind{{2, -1, 0}, 0.5};
  auto model = Cube(4);
  model->links[0].has_wind = true;
  world.AddRigid("box", model, At(0, 0, 1));
  world.AddRigid("sheltered", Cube(4), At(5, 0, 1));
  ASSERT_TRUE(world.Start());
  world.Run(2, kMediumStep);
  const double share = 1 - std::exp(-1.0);
  EXPECT_NEAR(world.body("box").linear_velocity.x, 2 * share, 1e-3);
  EXPECT_NEAR(world.body("box").linear_velocity.y, -share, 1e-3);
  EXPECT_NEAR(world.position("box").x, 2 * (2 - share / 0.5), 1e-3);
  EXPECT_EQ(world.position("sheltered").x, 5);
}

// A pendulum hangs at the angle at which the torques of wind and weight are in balance: tan a = d w
// / g.
TEST(Wind, DeflectsAPendulum) {
  TestWorld world(MakeWorldEngine());
  world.description().wind = model::Wind{{3, 0, 0}, 2};
  auto model = Cube(1);
  model->links[0].has_wind = true;
  model->links[0].model_from_link = {{0, 0, -1}, {}};
  model::Joint joint{"hinge", model::JointKind::kContinuous, -1, 0, {}};
  joint.axis = {0, -1, 0};
  joint.damping = 5;
  model->joints.push_back(joint);
  world.AddRigid("pendulum", model, At(0, 0, 5));
  ASSERT_TRUE(world.Start());
  world.Run(20, kMediumStep);
  EXPECT_NEAR(world.joint("pendulum", 0), std::atan(2 * 3 / kG), 0.02);
}

// The body rises with the acceleration (rho V / m - 1) g.
TEST(Buoyancy, LiftsBodiesLighterThanTheFluid) {
  TestWorld world(MakeWorldEngine());
  world.description().fluid = model::Fluid{1000, {}, {}};
  world.AddRigid("box", Cube(5), At(0, 0, -10));
  ASSERT_TRUE(world.Start());
  world.Run(0.5, kMediumStep);
  const double acceleration = (1000 * 0.008 / 5 - 1) * kG;
  EXPECT_NEAR(world.body("box").linear_velocity.z, acceleration * 0.5, 1e-9);
  EXPECT_NEAR(world.position("box").z, -10 + acceleration * 0.125, 1e-9);
}

TEST(Buoyancy, LiftsOnlyTheModelsThatItNames) {
  TestWorld world(MakeWorldEngine());
  world.description().fluid = model::Fluid{1000, {}, {"boat", "other::link"}};
  world.AddRigid("boat", Cube(5), At(0, 0, -10));
  world.AddRigid("other", Cube(5), At(5, 0, -10));
  world.AddRigid("stone", Cube(5), At(10, 0, -10));
  ASSERT_TRUE(world.Start());
  world.Run(0.1, kMediumStep);
  EXPECT_GT(world.position("boat").z, -10);
  EXPECT_GT(world.position("other").z, -10);
  EXPECT_LT(world.position("stone").z, -10);
}

// Archimedes' principle: the submerged fraction of a flat box that floats upright is its density
// divided by the density of the water.
TEST(Buoyancy, BoxFloatsAtTheDepthOfItsDensity) {
  for (const double share : {0.25, 0.5, 0.9}) {
    TestWorld world(MakeWorldEngine());
    world.description().fluid = model::Fluid{1000, {{0, 0}}, {}};
    auto model = SolidOf(geometry::Box{{0.4, 0.4, 0.1}}, 16 * share);
    model->links[0].linear_decay = 0.005;
    model->links[0].angular_decay = 0.005;
    world.AddRigid("box", model, At(0, 0, 0.1));
    ASSERT_TRUE(world.Start());
    world.Run(10, kMediumStep);
    EXPECT_NEAR(world.position("box").z, 0.05 - share * 0.1, 1e-3) << share;
  }
}

// The centre of a ball with half the density of the water is at the surface.
TEST(Buoyancy, BallFloatsAtTheDepthOfItsDensity) {
  TestWorld world(MakeWorldEngine());
  world.description().fluid = model::Fluid{1000, {{1, 0}}, {}};
  auto model = SolidOf(geometry::Sphere{0.3}, 500 * 4 * pi / 3 * 0.027);
  model->links[0].linear_decay = 0.005;
  world.AddRigid("ball", model, At(0, 0, 1.2));
  ASSERT_TRUE(world.Start());
  world.Run(20, kMediumStep);
  EXPECT_NEAR(world.position("ball").z, 1, 2e-3);
}

// A log that floats upright falls over, because the centre of the displaced volume is below its own
// centre.
TEST(Buoyancy, RotatesALogOntoItsSide) {
  TestWorld world(MakeWorldEngine());
  world.description().fluid = model::Fluid{1000, {{0, 0}}, {}};
  auto model = SolidOf(geometry::Cylinder{0.1, 1}, 500 * pi * 0.01);
  model->links[0].linear_decay = model->links[0].angular_decay = 0.003;
  world.AddRigid("log", model, {{0, 0, 0}, geometry::FromAxisAngle({1, 0, 0}, 0.1)});
  ASSERT_TRUE(world.Start());
  world.Run(30, kMediumStep);
  const Vector3 along = world.body("log").world_from_model.orientation * Vector3{0, 0, 1};
  EXPECT_NEAR(along.z, 0, 0.05);
}

TEST(KinematicLink, IgnoresForces) {
  TestWorld world = WorldOnGround();
  auto model = Cube(1);
  model->links[0].is_kinematic = true;
  world.AddRigid("shelf", model, At(0, 0, 1));
  world.AddRigid("stone", SolidOf(geometry::Sphere{0.1}, 50), At(0, 0, 1.5));
  ASSERT_TRUE(world.Start());
  world.Run(2, kMediumStep);
  EXPECT_EQ(world.position("shelf"), (Vector3{0, 0, 1}));
  // The tolerance is the distance that the stone falls in one substep.
  EXPECT_NEAR(world.position("stone").z, 1.2, 2e-3);
}

TEST(KinematicLink, MovesAtItsVelocityAndCarriesOtherBodies) {
  TestWorld world = WorldOnGround();
  auto pusher = Cube(1);
  pusher->links[0].is_kinematic = true;
  world.AddRigid("pusher", pusher, At(0, 0, 0.11));
  world.AddRigid("crate", SolidOf(geometry::Box{{0.4, 0.4, 0.4}}, 1000), At(0.5, 0, 0.2));
  ASSERT_TRUE(world.Start());
  world.body("pusher").linear_velocity = {0.5, 0, 0};
  world.Run(2, kMediumStep);
  EXPECT_NEAR(world.position("pusher").x, 1, 1e-9);
  EXPECT_NEAR(world.position("pusher").z, 0.11, 1e-9);
  EXPECT_NEAR(world.position("crate").x, 1.3, 5e-3);
}

TEST(KinematicLink, WithADriveFollowsTheDrivesCommand) {
  TestWorld world = WorldOnGround();
  auto model = Cube(1);
  model->links[0].is_kinematic = true;
  model->drive = model::Drive{};
  model->drive->kind = model::DriveKind::kVelocity;
  model->movement = model::Movement::kRigid;
  world.AddRigid("platform", model, At(0, 0, 2));
  ASSERT_TRUE(world.Start());
  world.Command("platform", {0.5, 0.25, 0});
  world.Run(2, kMediumStep);
  EXPECT_NEAR(world.position("platform").x, 1, 2e-3);
  EXPECT_NEAR(world.position("platform").y, 0.5, 2e-3);
  EXPECT_NEAR(world.position("platform").z, 2, 1e-9);
}

// A load does not move the arm, but the command of its joint does.
TEST(KinematicLink, OnAJointFollowsOnlyTheJointsCommand) {
  TestWorld world(MakeWorldEngine());
  auto model = Cube(1);
  model->links.push_back(testing::LinkOf(geometry::Box{{0.1, 0.1, 0.1}}, At(0.5, 0, 0)));
  model->links[1].name = "arm";
  model->links[1].is_kinematic = true;
  model->links[1].inertial.link_from_com = At(0.5, 0, 0);
  model->joints.push_back({"to_world", model::JointKind::kFixed, -1, 0, {}});
  model::Joint hinge{"hinge", model::JointKind::kContinuous, 0, 1, {}};
  hinge.axis = {0, 1, 0};
  model->joints.push_back(hinge);
  world.AddRigid("robot", model, At(0, 0, 1));
  ASSERT_TRUE(world.Start());
  world.Run(1, kMediumStep);
  EXPECT_NEAR(world.joint("robot", 1), 0, 1e-4);
  world.CommandJoint("robot", 1, {world::JointCommand::Kind::kVelocity, 0.5});
  world.Run(1, kMediumStep);
  EXPECT_NEAR(world.joint("robot", 1), 0.5, 1e-3);
}

}  // namespace
}  // namespace gsv::dynamics
