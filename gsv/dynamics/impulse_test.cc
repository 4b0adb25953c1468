// Tests the impulses that contacts report.
#include <cmath>

#include <gtest/gtest.h>

#include "gsv/dynamics/testing/test_rigid_world.h"

namespace gsv::dynamics {
namespace {

using testing::At;
using testing::SolidOf;
using testing::TestWorld;
using testing::WorldOnGround;

const geometry::Box kImpulseBox{{0.3, 0.3, 0.3}};

model::Surface SurfaceWith(double friction, double restitution) {
  model::Surface surface;
  surface.friction = surface.friction2 = friction;
  surface.restitution = restitution;
  return surface;
}

double ImpulseBetween(const TestWorld& world, const std::vector<world::Contact>& contacts,
                      const std::string& a, const std::string& b) {
  const int first = world.layout().Find(a), second = world.layout().Find(b);
  double impulse = 0;
  for (const world::Contact& contact : contacts) {
    const bool is_of_both = (contact.first == first && contact.second == second) ||
                            (contact.first == second && contact.second == first);
    if (is_of_both) impulse += contact.impulse;
  }
  return impulse;
}

class Collision : public ::testing::TestWithParam<double> {};

TEST_P(Collision, ImpulseReversesABody) {
  const double restitution = GetParam(), mass = 3, speed = 1.5;
  const model::Surface surface = SurfaceWith(0, restitution);
  TestWorld world = WorldOnGround(SurfaceWith(0, 0));
  auto wall = testing::ModelOf(geometry::Box{{0.2, 4, 1}});
  wall->links[0].collisions[0].surface = SurfaceWith(0, 1);
  world.AddStatic("wall", wall, At(1.1, 0, 0.5));
  world.AddRigid("box", SolidOf(kImpulseBox, mass, surface), At(0.6, 0, 0.15));
  ASSERT_TRUE(world.Start());
  world.body("box").linear_velocity = {speed, 0, 0};
  double impulse = 0;
  for (int i = 0; i < 60; ++i) impulse += ImpulseBetween(world, world.Step(0.01), "box", "wall");
  EXPECT_NEAR(impulse, mass * speed * (1 + restitution), 1e-3 * mass * speed);
  EXPECT_NEAR(impulse, mass * (speed - world.body("box").linear_velocity.x), 1e-3 * mass * speed);
}

INSTANTIATE_TEST_SUITE_P(Restitutions, Collision, ::testing::Values(0.0, 0.5, 1.0));

TEST(Impulse, OfAStackedBoxIsItsWeightTimesTheStep) {
  TestWorld world = WorldOnGround();
  world.AddRigid("lower", SolidOf(kImpulseBox, 4), At(0, 0, 0.15));
  world.AddRigid("upper", SolidOf(kImpulseBox, 2), At(0, 0, 0.45));
  ASSERT_TRUE(world.Start());
  world.Run(1, 0.01);
  EXPECT_NEAR(ImpulseBetween(world, world.Step(0.01), "lower", "upper"), 2 * testing::kG * 0.01,
              1e-3);
}

TEST(Impulse, OfAPushIsTheFrictionTimesTheStep) {
  auto robot = testing::DiscRobot();
  robot->links[0].inertial.mass = 20;
  TestWorld world = WorldOnGround(SurfaceWith(0.5, 0));
  world.AddRobot("robot", robot, {});
  world.AddRigid("box", SolidOf(kImpulseBox, 2), At(0.36, 0, 0.15));
  ASSERT_TRUE(world.Start());
  world.Command("robot", {0.5, 0, 0});
  world.Run(2, 0.01);
  double impulse = 0;
  for (int i = 0; i < 100; ++i) impulse += ImpulseBetween(world, world.Step(0.01), "robot", "box");
  EXPECT_NEAR(impulse, 0.5 * 2 * testing::kG * 1, 0.2);
}

TEST(Impulse, IsNanIfPlanarKinematicsStopsARobot) {
  TestWorld world = WorldOnGround();
  world.AddRobot("robot", testing::DiscRobot(), {});
  world.AddBox("wall", {0.2, 4, 1}, 0.4, 0);
  ASSERT_TRUE(world.Start());
  world.Command("robot", {0.5, 0, 0});
  world.Run(1, 0.01);
  const auto contacts = world.Step(0.01);
  ASSERT_EQ(contacts.size(), 1u);
  EXPECT_TRUE(std::isnan(contacts[0].impulse));
}

}  // namespace
}  // namespace gsv::dynamics
