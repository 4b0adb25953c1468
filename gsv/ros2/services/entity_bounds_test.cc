#include "gsv/ros2/services/entity_bounds.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "gsv/geometry/shape.h"

namespace gsv::ros2 {
namespace {

world::Snapshot SnapshotOf(const model::Model& model, const geometry::Pose& pose) {
  world::Snapshot snapshot;
  world::Body body;
  body.name = model.name;
  body.model = std::make_shared<const model::Model>(model);
  body.initial_pose = pose;
  snapshot.layout = world::MakeLayout(1, {body}, std::make_shared<model::WorldDescription>());
  snapshot.state = world::InitialState(*snapshot.layout);
  return snapshot;
}

model::Model BoxAbove(double height) {
  model::Model model;
  model.name = "box";
  model.links.resize(1);
  model::Collision collision;
  collision.shape = geometry::Box{{0.2, 0.4, 0.6}};
  collision.link_from_collision.position = {0, 0, height};
  model.links[0].collisions = {collision};
  return model;
}

TEST(EntityBounds, AreThoseOfTheCollisionShapesInTheBodysFrame) {
  const auto bounds = BoundsOfBody(SnapshotOf(BoxAbove(0.5), geometry::PlanarPose(7, 8, 0, 1)), 0);
  ASSERT_TRUE(bounds);
  EXPECT_NEAR(bounds->min.x, -0.1, 1e-12);
  EXPECT_NEAR(bounds->max.y, 0.2, 1e-12);
  EXPECT_NEAR(bounds->min.z, 0.2, 1e-12);
  EXPECT_NEAR(bounds->max.z, 0.8, 1e-12);
}

TEST(EntityBounds, AreAbsentForAPlane) {
  model::Model model = BoxAbove(0);
  model.links[0].collisions[0].shape = geometry::Plane{};
  EXPECT_FALSE(BoundsOfBody(SnapshotOf(model, {}), 0));
}

TEST(EntityBounds, SwapWidthAndDepthAfterAQuarterTurn) {
  const geometry::Bounds turned =
      InWorld({{-1, -2, 0}, {1, 2, 3}}, geometry::PlanarPose(10, 0, 0, std::numbers::pi / 2));
  EXPECT_NEAR(turned.min.x, 8, 1e-12);
  EXPECT_NEAR(turned.max.x, 12, 1e-12);
  EXPECT_NEAR(turned.min.y, -1, 1e-12);
  EXPECT_NEAR(turned.max.z, 3, 1e-12);
}

}  // namespace
}  // namespace gsv::ros2
