// Tests the forces of contacts against the laws of equilibrium and impact.
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

// Returns the sum of the forces (N) with which the first bodies of these contacts press the second
// bodies. Each force is the mean over a step of `step` seconds.
Vector3 ForceOf(const std::vector<world::Contact>& contacts, double step) {
  Vector3 force;
  for (const world::Contact& contact : contacts) {
    Vector3 of_contact;
    for (const world::ContactPoint& point : contact.points) of_contact += point.impulse;
    EXPECT_NEAR(Dot(of_contact, contact.normal), contact.impulse, 1e-12);
    force += of_contact * (1 / step);
  }
  return force;
}

TEST(ContactForce, BoxAtRestPressesWithItsWeight) {
  for (const double step : {0.001, 0.004, 0.01}) {
    TestWorld world = WorldOnGround();
    world.AddRigid("box", SolidOf(geometry::Box{{0.4, 0.3, 0.2}}, 2), At(0, 0, 0.1));
    ASSERT_TRUE(world.Start());
    world.Run(1, step);
    for (int i = 0; i < 3; ++i) {
      const Vector3 force = ForceOf(world.Step(step), step);
      EXPECT_WITHIN(force.z, -2 * kG, 1e-6, "N") << step;
      EXPECT_WITHIN(std::hypot(force.x, force.y), 0, 1e-6, "N") << step;
    }
  }
}

TEST(ContactForce, NormalAndFrictionForceOnASlopeFollowItsAngle) {
  const double angle = 0.3;
  const geometry::Quaternion turn = geometry::FromAxisAngle({0, 1, 0}, angle);
  TestWorld world(MakeWorldEngine());
  world.AddStatic("slope", testing::GroundOf(), {{}, turn});
  world.AddRigid("box", SolidOf(geometry::Box{{0.4, 0.3, 0.1}}, 2),
                 {turn * Vector3{0, 0, 0.05}, turn});
  ASSERT_TRUE(world.Start());
  world.Run(1, 0.001);
  const Vector3 force = Inverse(turn) * ForceOf(world.Step(0.001), 0.001);
  EXPECT_WITHIN(force.z, -2 * kG * std::cos(angle), 1e-3, "N");
  EXPECT_WITHIN(force.x, 2 * kG * std::sin(angle), 1e-3, "N");
  EXPECT_WITHIN(force.y, 0, 1e-3, "N");
}

TEST(ContactForce, SlidingBoxPullsTheGroundAlong) {
  TestWorld world = WorldOnGround();
  model::Surface surface;
  surface.friction = surface.friction2 = 0.5;
  world.AddRigid("box", SolidOf(geometry::Box{{0.4, 0.4, 0.1}}, 3, surface), At(0, 0, 0.05));
  ASSERT_TRUE(world.Start());
  world.body("box").linear_velocity = {1.6, 1.2, 0};
  world.Run(0.1, 0.001);
  // The box vibrates on its front edge by micrometres, so the force differs from step to step.
  Vector3 mean;
  for (int i = 0; i < 20; ++i) {
    const Vector3 force = ForceOf(world.Step(0.01), 0.01);
    EXPECT_WITHIN_PERCENT(force.x, -0.8 * 0.5 * force.z, 0.5);
    EXPECT_WITHIN_PERCENT(force.y, -0.6 * 0.5 * force.z, 0.5);
    mean += 0.05 * force;
  }
  EXPECT_WITHIN_PERCENT(-mean.z, 3 * kG, 0.5);
}

// The reported force is the mean over all substeps of a step, so it includes an impact in one of
// them.
TEST(ContactForce, ImpactTransmitsTheMomentumOfTheStep) {
  TestWorld world = WorldOnGround();
  world.AddRigid("ball", SolidOf(geometry::Sphere{0.1}, 2), At(0, 0, 0.12));
  ASSERT_TRUE(world.Start());
  world.body("ball").linear_velocity = {0, 0, -3};
  const Vector3 force = ForceOf(world.Step(0.05), 0.05);
  EXPECT_WITHIN_PERCENT(-force.z, 2 * 3 / 0.05 + 2 * kG, 0.1);
}

// The weight is 5 kg g, and each wheel should carry a quarter. The engine treats a robot as at rest
// if its accelerations are below 0.1 m/s² and 0.1 rad/s² (kResting), so the wheels' forces may
// differ. The linear acceleration permits a difference of 0.1 m/s² * 5 kg / 4 = 0.125 N per wheel.
// The angular acceleration permits 0.028 N: the moments of inertia are 0.069 kg m² about x and
// 0.134 kg m² about y, and the wheels are at y = ±0.15 m and x = ±0.2 m. The tolerance is the sum,
// 0.153 N.
TEST(ContactForce, WheelsCarryTheWeightOfTheirRobot) {
  auto model = SolidOf(geometry::Box{{0.4, 0.2, 0.1}}, 3);
  for (const double x : {-0.2, 0.2}) {
    for (const double y : {-0.15, 0.15}) {
      model::Joint joint;
      joint.kind = model::JointKind::kContinuous;
      joint.parent = 0;
      joint.child = static_cast<int>(model->links.size());
      joint.axis = {0, 1, 0};
      joint.model_from_joint = At(x, y, -0.05);
      model->joints.push_back(joint);
      model->links.push_back(SolidOf(geometry::Sphere{0.1}, 0.5)->links[0]);
      model->links.back().model_from_link = joint.model_from_joint;
    }
  }
  TestWorld world = WorldOnGround();
  world.AddRigid("robot", model, At(0, 0, 0.15));
  ASSERT_TRUE(world.Start());
  world.Run(1, 0.001);
  const std::vector<world::Contact> contacts = world.Step(0.001);
  EXPECT_WITHIN(ForceOf(contacts, 0.001).z, -5 * kG, 5 * 0.1, "N");
  ASSERT_EQ(contacts.size(), 1U);
  ASSERT_EQ(contacts[0].points.size(), 4U);
  for (const world::ContactPoint& point : contacts[0].points) {
    EXPECT_WITHIN(-point.impulse.z / 0.001, 5 * kG / 4, 0.153, "N");
  }
}

}  // namespace
}  // namespace gsv::dynamics
