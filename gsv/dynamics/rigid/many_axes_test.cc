// Tests joints with several axes, screws, links without gravity and surfaces with two friction
// coefficients against closed forms.

#include <gtest/gtest.h>

#include "gsv/base/test_within.h"
#include "gsv/dynamics/testing/test_rigid_world.h"
#include "gsv/geometry/constants.h"

namespace gsv::dynamics {
namespace {

using geometry::kPi;
using geometry::Pose;
using geometry::Vector3;
using model::JointKind;
using testing::At;
using testing::kG;
using testing::SolidOf;
using testing::TestWorld;
using testing::WorldOnGround;

constexpr double kLength = 0.5, kInertia = 1e-3;

// A ball of 1 kg that hangs from the world, kLength below a joint with consecutive `axes`. The
// model reader converts ball joints and universal joints to such joints.
std::shared_ptr<model::Model> HangingBy(JointKind kind, const std::vector<Vector3>& axes) {
  auto model = testing::ModelOf(geometry::Sphere{0.01}, At(0, 0, -kLength));
  model::Inertial& inertial = model->links[0].inertial;
  inertial.link_from_com = At(0, 0, -kLength);
  inertial.ixx = inertial.iyy = inertial.izz = kInertia;
  for (std::size_t i = 0; i < axes.size(); ++i) {
    model::Joint joint;
    joint.name = "joint" + std::to_string(i);
    joint.kind = kind;
    joint.axis = axes[i];
    joint.parent = i == 0 ? -1 : static_cast<int>(i);
    joint.child = i + 1 < axes.size() ? static_cast<int>(i) + 1 : 0;
    model->joints.push_back(joint);
    if (joint.child == 0) continue;
    model::Link cross;
    cross.inertial = {0, {}, 0, 0, 0};
    model->links.push_back(cross);
  }
  return model;
}

std::shared_ptr<model::Model> BallPendulum() {
  return HangingBy(JointKind::kBall, {{0, 0, 1}, {0, 1, 0}, {1, 0, 0}});
}

// The position of the bob relative to the joint.
Vector3 BobOf(const TestWorld& world, const model::Model& model) {
  return world::LinkPoses(model, world.state().joint_positions)[0] * Vector3{0, 0, -kLength};
}

TEST(ManyAxes, PendulumOnABallJointMovesOnACone) {
  // With equal inertia about all axes, the bob circles at the rate W with W² = g / (l cos a).
  const double angle = 0.7, rate = std::sqrt(kG / (kLength * std::cos(angle)));
  const auto model = BallPendulum();
  TestWorld world(MakeWorldEngine());
  world.AddRigid("pendulum", model, At(0, 0, 2));
  ASSERT_TRUE(world.Start());
  world.state().joint_positions = {0, angle, 0};
  world.state().joint_velocities = {rate * std::cos(angle), 0, -rate * std::sin(angle)};
  const Vector3 start = BobOf(world, *model);
  EXPECT_NEAR(start.x, -kLength * std::sin(angle), 1e-12);
  const double period = 2 * kPi / rate, step = period / 2000;
  for (int i = 0; i < 500; ++i) world.Step(step);
  EXPECT_WITHIN(BobOf(world, *model).y, -kLength * std::sin(angle), 2e-3, "m");
  for (int i = 500; i < 2000; ++i) {
    world.Step(step);
    ASSERT_WITHIN(BobOf(world, *model).z, -kLength * std::cos(angle), 2e-3, "m");
  }
  EXPECT_WITHIN(BobOf(world, *model).x, start.x, 5e-3, "m");
  EXPECT_WITHIN(BobOf(world, *model).y, start.y, 5e-3, "m");
}

// The motion passes the singularity, at which two of the three axes coincide. Energy and angular
// momentum about the vertical are conserved.
TEST(ManyAxes, ABallJointRotatesAboutAnyAxis) {
  const auto model = BallPendulum();
  TestWorld world(MakeWorldEngine());
  world.AddRigid("pendulum", model, At(0, 0, 2));
  ASSERT_TRUE(world.Start());
  world.state().joint_positions = {0.2, 2, -0.4};
  world.state().joint_velocities = {3, 0, 2};
  // the energy between the lowest and the highest position
  constexpr double kHighestEnergy = 2 * kG * kLength, step = 0.001;
  const auto measure = [&](double& energy, double& turning) {
    const Vector3 before = BobOf(world, *model);
    const Vector3 rates{world.joint_velocity("pendulum", 0), world.joint_velocity("pendulum", 1),
                        world.joint_velocity("pendulum", 2)};
    world.Step(step);
    const Vector3 after = BobOf(world, *model);
    const Vector3 velocity = (after - before) * (1 / step), at = (after + before) * 0.5;
    energy = Dot(velocity, velocity) / 2 + kInertia * Dot(rates, rates) / 2 + kG * at.z;
    turning = Cross(at, velocity).z;
  };
  double energy = 0, turning = 0, widest = 0;
  measure(energy, turning);
  for (int i = 0; i < 3000; ++i) {
    double e = 0, t = 0;
    measure(e, t);
    ASSERT_WITHIN(100 * (e - energy) / kHighestEnergy, 0, 2, "%") << i;
    ASSERT_WITHIN(100 * (t - turning) / (std::abs(turning) + 1), 0, 2, "%") << i;
    widest = std::max(widest, std::abs(world.joint("pendulum", 1)));
  }
  EXPECT_GT(widest, 1.4);
}

TEST(ManyAxes, AUniversalJointSwingsAboutBothAxes) {
  const auto model = HangingBy(JointKind::kContinuous, {{1, 0, 0}, {0, 1, 0}});
  TestWorld world(MakeWorldEngine());
  world.AddRigid("pendulum", model, At(0, 0, 2));
  ASSERT_TRUE(world.Start());
  world.state().joint_positions = {0.05, -0.03};
  const double period = 2 * kPi * std::sqrt((kInertia + kLength * kLength) / (kG * kLength)),
               step = period / 2000;
  for (int i = 0; i < 1000; ++i) world.Step(step);
  EXPECT_WITHIN(world.joint("pendulum", 0), -0.05, 5e-4, "rad");
  EXPECT_WITHIN(world.joint("pendulum", 1), 0.03, 5e-4, "rad");
  for (int i = 0; i < 1000; ++i) world.Step(step);
  EXPECT_WITHIN(world.joint("pendulum", 0), 0.05, 5e-4, "rad");
  EXPECT_WITHIN(world.joint("pendulum", 1), -0.03, 5e-4, "rad");
}

TEST(ManyAxes, UniversalJointIsDamped) {
  auto model = HangingBy(JointKind::kContinuous, {{1, 0, 0}, {0, 1, 0}});
  model->joints[0].damping = 0.2;
  TestWorld world(MakeWorldEngine());
  world.AddRigid("pendulum", model, At(0, 0, 2));
  ASSERT_TRUE(world.Start());
  world.state().joint_positions = {0.05, 0.05};
  world.Run(20, 0.01);
  EXPECT_NEAR(world.joint("pendulum", 0), 0, 1e-3);
}

TEST(ManyAxes, ScrewJointMovesAlongItsAxisAsItTurns) {
  const double pitch = 0.1, inertia = 0.01;
  auto model = testing::ModelOf(geometry::Sphere{0.05});
  model->links[0].inertial = {1, {}, inertia, inertia, inertia};
  model::Joint joint;
  joint.kind = JointKind::kScrew;
  joint.thread_pitch = pitch;
  model->joints.push_back(joint);
  TestWorld world(MakeWorldEngine());
  world.AddRigid("nut", model, At(0, 0, 5));
  ASSERT_TRUE(world.Start());
  world.Run(0.5, 0.001);
  // The nut moves by `pitch` m per radian, so its weight accelerates its mass (1 kg) and its
  // inertia. The angular acceleration is -g pitch / (inertia + 1 kg pitch²), here for 0.5 s.
  const double angle = -kG * pitch / (inertia + pitch * pitch) * 0.5 * 0.5 / 2;
  EXPECT_WITHIN_PERCENT(world.joint("nut", 0), angle, 0.5);
  const Pose nut = world::LinkPoses(*model, world.state().joint_positions)[0];
  EXPECT_NEAR(nut.position.z, pitch * world.joint("nut", 0), 1e-9);
  EXPECT_NEAR(geometry::WrapAngle(geometry::Yaw(nut.orientation) - world.joint("nut", 0)), 0, 1e-9);
}

TEST(ManyAxes, LinkWithoutGravityFloats) {
  auto balloon = SolidOf(geometry::Sphere{0.1}, 2);
  balloon->links[0].has_gravity = false;
  auto arm = HangingBy(JointKind::kRevolute, {{0, 1, 0}});
  arm->links[0].has_gravity = false;
  TestWorld world = WorldOnGround();
  world.AddRigid("balloon", balloon, At(0, 0, 3));
  world.AddRigid("arm", arm, At(5, 0, 3));
  ASSERT_TRUE(world.Start());
  world.state().joint_positions[0] = 1;
  world.body("balloon").linear_velocity = {0, 0, 1};
  world.Run(1, 0.01);
  EXPECT_WITHIN(world.position("balloon").z, 4, 1e-9, "m");
  EXPECT_WITHIN(world.joint("arm", 0), 1, 1e-9, "rad");
}

// A box, rotated by `yaw`, slides along the world's x axis from 2 m/s to a stop.
double SlidingDistance(const model::Surface& surface, double yaw) {
  TestWorld world = WorldOnGround();
  world.AddRigid("box", SolidOf(geometry::Box{{0.4, 0.4, 0.1}}, 3, surface),
                 geometry::PlanarPose(0, 0, 0.05, yaw));
  EXPECT_TRUE(world.Start());
  world.body("box").linear_velocity = {2, 0, 0};
  world.Run(3, 0.001);
  EXPECT_EQ(world.body("box").linear_velocity, Vector3{});
  return world.position("box").x;
}

TEST(ManyAxes, FrictionMayDifferBetweenDirections) {
  model::Surface surface{0.5, 0.1, 0, {1, 0, 0}};
  const double along = 2 * 2 / (2 * 0.5 * kG), across = 2 * 2 / (2 * 0.1 * kG);
  EXPECT_WITHIN_PERCENT(SlidingDistance(surface, 0), along, 1);
  EXPECT_WITHIN_PERCENT(SlidingDistance(surface, kPi / 2), across, 1);
  surface.friction_direction = {0, 1, 0};
  EXPECT_WITHIN_PERCENT(SlidingDistance(surface, 0), across, 1);
}

TEST(ManyAxes, ModelsControllersApplyFromTheStart) {
  auto slider = HangingBy(JointKind::kPrismatic, {{1, 0, 0}});
  slider->joint_targets.push_back({0, model::JointTarget::Kind::kVelocity, 0.4});
  auto arm = HangingBy(JointKind::kRevolute, {{0, 1, 0}});
  arm->joint_targets.push_back({0, model::JointTarget::Kind::kPosition, 0.6});
  TestWorld world(MakeWorldEngine());
  world.AddRigid("slider", slider, At(0, 0, 2));
  world.AddRigid("arm", arm, At(9, 0, 2));
  ASSERT_TRUE(world.Start());
  world.Run(1, 0.01);
  EXPECT_NEAR(world.joint_velocity("slider", 0), 0.4, 1e-6);
  EXPECT_NEAR(world.joint("arm", 0), 0.6, 1e-3);
}

}  // namespace
}  // namespace gsv::dynamics
