// Tests that overlapping bodies separate without any gain of kinetic energy.
#include "gsv/dynamics/rigid/overlap_removal.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "gsv/base/test_within.h"
#include "gsv/dynamics/testing/test_rigid_world.h"

namespace gsv::dynamics {
namespace {

using testing::At;
using testing::EnergyOf;
using testing::SolidOf;
using testing::TestWorld;
using testing::WorldOnGround;

constexpr double kSubstep = 0.001, kEdge = 0.3;
constexpr double kTolerated = 1e-4;  // overlap that is not removed, m
// Returns the overlap beyond kTolerated, in m, that may remain. Each step moves a body by the
// fraction `part` of the removed overlap. If the overlap is smaller than the result, this motion is
// slower than 0.1 mm/s, so the body counts as at rest.
double RestingExcess(double part) { return 1e-4 * kSubstep / OverlapRemoval::kShare / part; }

double DeepestOf(const std::vector<world::Contact>& contacts) {
  double deepest = 0;
  for (const world::Contact& contact : contacts) deepest = std::max(deepest, contact.depth);
  return deepest;
}

// In each step, a fifth of the overlap beyond the tolerated overlap is removed. The speed limits of
// both boxes also limit what a step removes.
TEST(OverlapRemoval, TwoBoxesLoseAFifthOfTheirOverlapPerStep) {
  TestWorld world = WorldOnGround();
  const double light = 1, heavy = 3, start = 0.02;
  world.AddRigid("a", SolidOf(geometry::Box{{kEdge, kEdge, kEdge}}, light), At(0, 0, kEdge / 2));
  world.AddRigid("b", SolidOf(geometry::Box{{kEdge, kEdge, kEdge}}, heavy),
                 At(kEdge - start, 0, kEdge / 2));
  ASSERT_TRUE(world.Start());
  const double energy = EnergyOf(world);
  // The lighter box moves at the greatest speed, and the heavier one at a third of it.
  const double fastest = OverlapRemoval::kMaxSpeed * kSubstep * (1 + light / heavy);
  const double last = kTolerated + RestingExcess(light / (light + heavy));
  double expected = start;
  while (expected > last) {
    expected -= std::min(OverlapRemoval::kShare * (expected - kTolerated), fastest);
    world.Step(kSubstep);
    const double a = world.position("a").x, b = world.position("b").x;
    EXPECT_WITHIN(kEdge - (b - a), expected, 1e-9, "m");
    EXPECT_WITHIN(light * a + heavy * (b - (kEdge - start)), 0, 1e-9, "kg m");
    EXPECT_LT(EnergyOf(world), energy + 1e-9);
  }
  world.Run(0.1, kSubstep);
  EXPECT_LT(kEdge - (world.position("b").x - world.position("a").x), last);
}

TEST(OverlapRemoval, BoxThatStartsInTheGroundRises) {
  TestWorld world = WorldOnGround();
  world.AddRigid("box", SolidOf(geometry::Box{{kEdge, kEdge, kEdge}}, 1),
                 At(0, 0, kEdge / 2 - 0.01));
  ASSERT_TRUE(world.Start());
  world.Run(0.1, kSubstep);
  EXPECT_WITHIN(world.position("box").z, kEdge / 2 - kTolerated, RestingExcess(1), "m");
  EXPECT_EQ(world.body("box").linear_velocity, geometry::Vector3());
}

// Boxes of which some start 7 cm inside each other fall on a heap.
TEST(OverlapRemoval, HeapThatStartsWithOverlapsLosesThemAndGainsNoEnergy) {
  TestWorld world = WorldOnGround();
  for (int i = 0; i < 64; ++i) {
    const int column = i % 4, row = i / 4 % 4, layer = i / 16;
    world.AddRigid(
        "box" + std::to_string(i), SolidOf(geometry::Box{{kEdge, kEdge, kEdge}}, 1),
        At(0.35 * column + 0.02 * (i % 7), 0.35 * row + 0.013 * (i % 5), 0.3 + 0.4 * layer));
  }
  ASSERT_TRUE(world.Start());
  EXPECT_GT(DeepestOf(world.Step(kSubstep)), 0.06);
  double energy = EnergyOf(world), deepest = 0;
  for (int i = 0; i < 2000; ++i) {
    deepest = DeepestOf(world.Step(kSubstep));
    // Bodies that move apart may also rise, at most at the greatest speed. This adds potential
    // energy.
    const double now = EnergyOf(world);
    EXPECT_LT(now, energy + 64 * testing::kG * OverlapRemoval::kMaxSpeed * kSubstep);
    energy = now;
  }
  // The boxes are equal, so each of two boxes moves by a half of the correction.
  EXPECT_WITHIN(deepest, 0, kTolerated + RestingExcess(0.5), "m");
  const double at_rest = 64 * testing::kG * kEdge / 2;
  EXPECT_GT(energy, at_rest);
  for (const world::BodyState& body : world.state().bodies) {
    EXPECT_WITHIN(Norm(body.linear_velocity), 0, 1e-4, "m/s");
  }
}

}  // namespace
}  // namespace gsv::dynamics
