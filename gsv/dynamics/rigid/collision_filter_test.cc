// Tests collision bitmasks, in rigid-body dynamics and in planar kinematics.
#include <gtest/gtest.h>

#include "gsv/dynamics/testing/test_rigid_world.h"

namespace gsv::dynamics {
namespace {

using model::CollisionFilter;
using testing::At;
using testing::BoxRobot;
using testing::kG;
using testing::ModelOf;
using testing::SolidOf;
using testing::TestWorld;
using testing::WorldOnGround;

constexpr double kFilterStep = 0.002;

std::shared_ptr<model::Model> Filtered(std::shared_ptr<model::Model> model,
                                       const CollisionFilter& filter) {
  for (model::Link& link : model->links) {
    for (model::Collision& collision : link.collisions) collision.surface.filter = filter;
  }
  return model;
}

model::Surface SurfaceWith(const CollisionFilter& filter) {
  model::Surface surface;
  surface.filter = filter;
  return surface;
}

geometry::Shape CubeAsMesh() {
  return geometry::Mesh{std::make_shared<const geometry::TriangleMesh>(
      geometry::Tessellate(geometry::Box{{1, 1, 1}}))};
}

TEST(CollisionFilter, BodiesCollideIfOneBodySelectsTheOthersCategory) {
  EXPECT_TRUE(model::Meet({}, {}));
  EXPECT_FALSE(model::Meet({0, 0}, {}));
  EXPECT_FALSE(model::Meet({1, 1}, {2, 2}));
  EXPECT_TRUE(model::Meet({1, 3}, {2, 2}));
  EXPECT_TRUE(model::Meet({1, 0}, {2, 1}));
}

TEST(CollisionFilter, BodyThatCollidesWithNothingFallsThroughTheGround) {
  TestWorld world = WorldOnGround();
  world.AddRigid("box", SolidOf(geometry::Box{{0.2, 0.2, 0.2}}, 1, SurfaceWith({0, 0})),
                 At(0, 0, 1));
  ASSERT_TRUE(world.Start());
  world.Run(1, kFilterStep);
  EXPECT_NEAR(world.position("box").z, 1 - kG / 2, 1e-9);
}

// Two spheres fall onto a box, then onto a mesh. Only the sphere that has a collision bit in common
// with the box or mesh comes to rest on it.
TEST(CollisionFilter, BodyRestsOnABodyOfItsCategory) {
  for (const geometry::Shape& shape : {geometry::Shape(geometry::Box{{1, 1, 1}}), CubeAsMesh()}) {
    TestWorld world(MakeWorldEngine());
    world.AddStatic("table", Filtered(ModelOf(shape), {2, 2}), At(0, 0, -0.5));
    world.AddRigid("through", SolidOf(geometry::Sphere{0.1}, 1, SurfaceWith({1, 1})),
                   At(-0.2, 0, 0.2));
    world.AddRigid("upon", SolidOf(geometry::Sphere{0.1}, 1, SurfaceWith({2, 2})), At(0.2, 0, 0.2));
    ASSERT_TRUE(world.Start());
    world.Run(1, kFilterStep);
    EXPECT_NEAR(world.position("through").z, 0.2 - kG / 2, 1e-9);
    EXPECT_NEAR(world.position("upon").z, 0.1, 1e-3);
  }
}

// Each shape of a body has its own collision bits.
TEST(CollisionFilter, ShapesOfOneBodyHaveTheirOwnFilters) {
  TestWorld world(MakeWorldEngine());
  world.AddStatic("ground", Filtered(testing::GroundOf(), {2, 2}), {});
  auto model = SolidOf(geometry::Box{{0.2, 0.2, 0.2}}, 1, SurfaceWith({2, 2}));
  // The shape extends 0.4 m lower, and does not collide with anything there.
  model->links[0].collisions.push_back(model->links[0].collisions[0]);
  model->links[0].collisions[1].shape = geometry::Box{{0.1, 0.1, 1}};
  model->links[0].collisions[1].surface.filter = {1, 1};
  world.AddRigid("box", model, At(0, 0, 0.3));
  ASSERT_TRUE(world.Start());
  world.Run(1, kFilterStep);
  EXPECT_NEAR(world.position("box").z, 0.1, 1e-3);
}

TEST(CollisionFilter, BodiesOfDifferentCategoriesFallThroughEachOther) {
  TestWorld world(MakeWorldEngine());
  world.AddStatic("ground", testing::GroundOf(), {});
  const geometry::Box cube{{0.2, 0.2, 0.2}};
  world.AddRigid("low", SolidOf(cube, 1, SurfaceWith({1, 1})), At(0, 0, 0.1));
  world.AddRigid("high", SolidOf(cube, 1, SurfaceWith({2, 2})), At(0, 0, 0.5));
  ASSERT_TRUE(world.Start());
  world.Run(1, kFilterStep);
  EXPECT_NEAR(world.position("high").z, 0.1, 1e-3);
}

TEST(CollisionFilter, PlanarRobotDrivesThroughWallsOfOtherCategories) {
  for (const auto& [bits, x] : {std::pair<std::uint16_t, double>{1, 0.8}, {2, 2}}) {
    TestWorld world(MakeWorldEngine());
    world.AddStatic("wall", Filtered(ModelOf(geometry::Box{{0.2, 4, 1}}), {1, 1}),
                    At(1.15, 0, 0.5));
    world.AddRobot("robot", Filtered(BoxRobot(0.5, 0.3), {bits, bits}), {});
    ASSERT_TRUE(world.Start());
    world.Command("robot", {1, 0, 0});
    world.Run(2, 0.02);
    EXPECT_NEAR(world.position("robot").x, x, 2e-3) << bits;
  }
}

TEST(CollisionFilter, PlanarRobotsOfDifferentCategoriesPassThroughEachOther) {
  for (const auto& [bits, x] : {std::pair<std::uint16_t, double>{1, 0.5}, {2, 2}}) {
    TestWorld world(MakeWorldEngine());
    world.AddRobot("standing", Filtered(BoxRobot(0.5, 0.3), {1, 1}), At(1, 0, 0));
    world.AddRobot("driving", Filtered(BoxRobot(0.5, 0.3), {bits, bits}), {});
    ASSERT_TRUE(world.Start());
    world.Command("driving", {1, 0, 0});
    world.Run(2, 0.02);
    EXPECT_NEAR(world.position("driving").x, x, 2e-3) << bits;
  }
}

}  // namespace
}  // namespace gsv::dynamics
