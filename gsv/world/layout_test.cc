#include "gsv/world/layout.h"

#include <gtest/gtest.h>

namespace gsv::world {
namespace {

using model::Movement;

model::Model ModelWith(bool has_drive, bool collides) {
  model::Model model;
  model.links.resize(1);
  if (has_drive) model.drive.emplace();
  if (collides) model.links[0].collisions.resize(1);
  return model;
}

TEST(KindOf, FollowsDriveMovementAndCollisions) {
  struct Case {
    bool has_drive, collides;
    Movement movement;
    BodyKind kind;
  };
  const Case cases[] = {
      {true, true, Movement::kPlanar, BodyKind::kPlanarBase},
      {true, true, Movement::kRigid, BodyKind::kRigidBody},
      {true, false, Movement::kPlanar, BodyKind::kPlanarBase},
      // A driven body without collisions cannot stand on the ground, so it is planar.
      {true, false, Movement::kRigid, BodyKind::kPlanarBase},
      {false, true, Movement::kPlanar, BodyKind::kRigidBody},
      {false, true, Movement::kRigid, BodyKind::kRigidBody},
      {false, false, Movement::kPlanar, BodyKind::kUnmoved},
      {false, false, Movement::kRigid, BodyKind::kUnmoved},
  };
  for (const Case& c : cases) {
    const model::Model model = ModelWith(c.has_drive, c.collides);
    EXPECT_EQ(KindOf(model, false, c.movement), c.kind) << c.has_drive << c.collides;
    EXPECT_EQ(KindOf(model, true, c.movement), BodyKind::kStatic);
  }
}

TEST(KindOf, IsStaticForAStaticWorldOrModel) {
  model::Model model = ModelWith(false, true);
  const auto kind_of = [&](bool is_placed_static) {
    return KindOf({"box", std::make_shared<model::Model>(model), {}, is_placed_static});
  };
  EXPECT_EQ(kind_of(false), BodyKind::kRigidBody);
  EXPECT_EQ(kind_of(true), BodyKind::kStatic);
  model.is_static = true;
  EXPECT_EQ(kind_of(false), BodyKind::kStatic);
}

TEST(Body, IsARobotIfItHasADriveAndIsNotStatic) {
  const auto is_robot = [](BodyKind kind, bool has_drive) {
    Body body;
    body.model = std::make_shared<model::Model>(ModelWith(has_drive, true));
    body.kind = kind;
    return body.is_robot();
  };
  EXPECT_TRUE(is_robot(BodyKind::kPlanarBase, true));
  EXPECT_TRUE(is_robot(BodyKind::kAvatar, true));
  EXPECT_TRUE(is_robot(BodyKind::kRigidBody, true));
  EXPECT_FALSE(is_robot(BodyKind::kRigidBody, false));
  EXPECT_FALSE(is_robot(BodyKind::kStatic, true));
}

}  // namespace
}  // namespace gsv::world
