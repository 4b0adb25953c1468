// Tests properties that must hold in every world with rigid bodies.
#include <gtest/gtest.h>

#include "gsv/base/random.h"
#include "gsv/base/test_within.h"
#include "gsv/dynamics/testing/test_rigid_world.h"

namespace gsv::dynamics {
namespace {

using geometry::Pose;
using geometry::Vector3;
using testing::SolidOf;
using testing::TestWorld;
using testing::WorldOnGround;

// A heap of solids that fall over each other, and robots that drive into it.
TestWorld Heap(std::uint64_t seed, const Vector3& offset = {}) {
  base::Noise noise(seed, 1, 2);
  const auto uniform = [&](double low, double high) {
    return low + (high - low) * noise.Uniform();
  };
  TestWorld world(MakeWorldEngine());
  world.AddStatic("ground", testing::GroundOf(), {offset, {}});
  for (int i = 0; i < 8; ++i) {
    const double size = uniform(0.2, 0.4);
    const geometry::Shape shapes[] = {geometry::Box{{size, 0.3, 0.2}}, geometry::Sphere{size / 2},
                                      geometry::Cylinder{size / 2, 0.3}};
    const Pose pose{offset + Vector3{uniform(-0.5, 0.5), uniform(-0.5, 0.5), 0.3 + 0.4 * i},
                    geometry::FromRollPitchYaw({uniform(-1, 1), uniform(-1, 1), uniform(-3, 3)})};
    world.AddRigid("solid" + std::to_string(i), SolidOf(shapes[i % 3], uniform(0.5, 3)), pose);
  }
  for (int i = 0; i < 3; ++i) {
    auto robot = testing::DiscRobot(0.2);
    robot->links[0].inertial.mass = 15;
    world.AddRobot("robot" + std::to_string(i), robot,
                   Pose{offset, {}} * geometry::PlanarPose(-2, i - 1.0, 0, uniform(-0.2, 0.2)));
  }
  EXPECT_TRUE(world.Start());
  for (int i = 0; i < 3; ++i) world.Command("robot" + std::to_string(i), {0.8, 0, 0.1});
  return world;
}

TEST(RigidProperty, RunIsRepeatable) {
  TestWorld first = Heap(1), second = Heap(1);
  for (int i = 0; i < 300; ++i) {
    first.Step(0.01);
    second.Step(0.01);
    ASSERT_EQ(first.Digest(), second.Digest()) << "step " << i;
  }
}

TEST(RigidProperty, StepDependsOnlyOnTheState) {
  // A new engine, without data of earlier steps, computes the same step.
  TestWorld lived = Heap(2), fresh = Heap(2);
  lived.Run(1, 0.01);
  fresh.state() = lived.state();
  lived.Run(0.5, 0.01);
  fresh.Run(0.5, 0.01);
  EXPECT_EQ(lived.Digest(), fresh.Digest());
}

TEST(RigidProperty, OverlapQueriesDoNotChangeTheState) {
  TestWorld first = Heap(3), second = Heap(3);
  for (int i = 0; i < 100; ++i) {
    first.Step(0.01);
    second.Step(0.01);
    second.engine().Overlaps(second.state(), 1e-3);
  }
  EXPECT_EQ(first.Digest(), second.Digest());
}

TEST(RigidProperty, BodiesNeverPenetrateTheGroundOrEachOther) {
  for (std::uint64_t seed = 10; seed < 13; ++seed) {
    TestWorld world = Heap(seed);
    for (int i = 0; i < 300; ++i) {
      world.Step(0.01);
      for (int s = 0; s < 8; ++s) {
        ASSERT_GT(world.position("solid" + std::to_string(s)).z, 0.05) << seed << ", step " << i;
      }
    }
    // Overlaps of up to 2 mm are permitted: a robot touches a body that it collides with, and a
    // falling body may be pressed against a robot.
    double deepest = 0;
    for (const auto& overlap : world.engine().Overlaps(world.state(), 0)) {
      deepest = std::max(deepest, overlap.depth);
      EXPECT_LE(overlap.depth, 2e-3) << seed << ": " << world.layout().bodies[overlap.first].name
                                     << " in " << world.layout().bodies[overlap.second].name;
    }
    EXPECT_WITHIN(deepest, 0, 2e-3, "m") << seed;
  }
}

TEST(RigidProperty, ResultDoesNotDependOnTheWorldsPosition) {
  // The distances are powers of two, so that the initial positions are rounded almost alike. The
  // test ends before chaos amplifies the small differences.
  TestWorld here = Heap(4), there = Heap(4, {128, -64, 0});
  here.Run(0.3, 0.01);
  there.Run(0.3, 0.01);
  for (int s = 0; s < 8; ++s) {
    const std::string name = "solid" + std::to_string(s);
    EXPECT_WITHIN(here.position(name).x + 128, there.position(name).x, 1e-6, "m") << name;
    EXPECT_WITHIN(here.position(name).y - 64, there.position(name).y, 1e-6, "m") << name;
    EXPECT_WITHIN(here.position(name).z, there.position(name).z, 1e-6, "m") << name;
  }
}

}  // namespace
}  // namespace gsv::dynamics
