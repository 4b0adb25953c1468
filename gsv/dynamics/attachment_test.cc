#include <gtest/gtest.h>

#include "gsv/dynamics/testing/test_rigid_world.h"

namespace gsv::dynamics {
namespace {

using geometry::Pose;
using geometry::Vector3;
using testing::At;
using testing::TestWorld;

constexpr double kAttachedStep = 0.01;
constexpr double kCrateSide = 0.2;  // edge length of the crate, m

const Pose kLinkFromCrate = At(0.35, 0, 0.25);

std::shared_ptr<model::Model> GraspedCrate() {
  return testing::SolidOf(geometry::Box{{kCrateSide, kCrateSide, kCrateSide}}, 1);
}

// A disc robot of 0.2 m radius at the origin, a crate between it and a wall whose near side is at
// x = 1, and another crate beside this line.
TestWorld GraspScene() {
  TestWorld world = testing::WorldOnGround();
  world.AddBox("wall", {0.2, 4, 1}, 1.1, 0);
  world.AddRobot("robot", testing::DiscRobot(), {});
  world.AddRigid("crate", GraspedCrate(), kLinkFromCrate);
  world.AddRigid("other", GraspedCrate(), At(0.6, 0.5, kCrateSide / 2));
  return world;
}

Attachment HoldCrate(const TestWorld& world, const Pose& link_from_held = kLinkFromCrate) {
  return {world.layout().Find("robot"), 0, world.layout().Find("crate"), link_from_held};
}

// Moves the attached crate with the robot, as a caller of the engine must do. The engine itself
// does not move attached bodies.
void CarryCrate(TestWorld& world) {
  world.body("crate").world_from_model = world.body("robot").world_from_model * kLinkFromCrate;
}

TEST(Attachment, AttachedBodyStopsItsHolderAtAWall) {
  TestWorld world = GraspScene();
  ASSERT_TRUE(world.Start());
  ASSERT_TRUE(world.engine().Attach(HoldCrate(world), world.state()));
  world.Command("robot", {0.5, 0, 0});
  world.Run(3, kAttachedStep);
  EXPECT_NEAR(world.position("robot").x, 1 - 0.35 - kCrateSide / 2, 1e-4);
}

TEST(Attachment, MovesLikeOneModelWithAllShapes) {
  TestWorld attached = GraspScene();
  ASSERT_TRUE(attached.Start());
  ASSERT_TRUE(attached.engine().Attach(HoldCrate(attached), attached.state()));

  auto robot = testing::DiscRobot();
  model::Collision held = GraspedCrate()->links[0].collisions[0];
  held.link_from_collision = kLinkFromCrate;
  robot->links[0].collisions.push_back(held);
  auto nothing = GraspedCrate();
  nothing->links[0].collisions.clear();
  TestWorld built = testing::WorldOnGround();
  built.AddBox("wall", {0.2, 4, 1}, 1.1, 0);
  built.AddRobot("robot", robot, {});
  built.AddStatic("crate", nothing, kLinkFromCrate);
  built.AddRigid("other", GraspedCrate(), At(0.6, 0.5, kCrateSide / 2));
  ASSERT_TRUE(built.Start());

  for (TestWorld* world : {&attached, &built}) world->Command("robot", {0.4, 0, 0.6});
  for (int i = 0; i < 300; ++i) {
    for (TestWorld* world : {&attached, &built}) {
      world->Step(kAttachedStep);
      CarryCrate(*world);
    }
    ASSERT_EQ(attached.Digest(), built.Digest()) << "after step " << i;
  }
}

TEST(Attachment, KeepsTheAttachedBodyAtItsPoseInTheState) {
  TestWorld world = GraspScene();
  ASSERT_TRUE(world.Start());
  ASSERT_TRUE(world.engine().Attach(HoldCrate(world), world.state()));
  world.Run(1, kAttachedStep);
  EXPECT_EQ(world.body("crate").world_from_model, kLinkFromCrate);
}

TEST(Attachment, DetachedBodyFalls) {
  TestWorld world = GraspScene();
  ASSERT_TRUE(world.Start());
  ASSERT_TRUE(world.engine().Attach(HoldCrate(world), world.state()));
  world.engine().Detach(world.layout().Find("crate"));
  world.Run(1, kAttachedStep);
  EXPECT_NEAR(world.position("crate").z, kCrateSide / 2, 1e-3);
}

TEST(Attachment, EndsWhenALayoutIsSet) {
  TestWorld world = GraspScene();
  ASSERT_TRUE(world.Start());
  ASSERT_TRUE(world.engine().Attach(HoldCrate(world), world.state()));
  ASSERT_TRUE(world.Start());
  world.Run(1, kAttachedStep);
  EXPECT_NEAR(world.position("crate").z, kCrateSide / 2, 1e-3);
}

TEST(Attachment, DoesNotDependOnTheOrderOfAttaching) {
  const auto digest_after = [](bool crate_first) {
    TestWorld world = GraspScene();
    EXPECT_TRUE(world.Start());
    Attachment crate = HoldCrate(world), other = HoldCrate(world, At(-0.35, 0, 0.25));
    other.held_body = world.layout().Find("other");
    if (!crate_first) std::swap(crate, other);
    EXPECT_TRUE(world.engine().Attach(crate, world.state()));
    EXPECT_TRUE(world.engine().Attach(other, world.state()));
    world.Command("robot", {0.4, 0, 0.6});
    world.Run(2, kAttachedStep);
    return world.Digest();
  };
  EXPECT_EQ(digest_after(true), digest_after(false));
}

TEST(Attachment, AttachedShapesCauseOverlapsAtOnce) {
  TestWorld world = GraspScene();
  ASSERT_TRUE(world.Start());
  const int robot = world.layout().Find("robot");
  world.body("robot").world_from_model.position = {0.6, -0.6, 0};
  EXPECT_TRUE(world.engine().OverlapsOf(world.state(), robot, 1e-3).empty());
  ASSERT_TRUE(world.engine().Attach(HoldCrate(world), world.state()));
  const auto overlaps = world.engine().OverlapsOf(world.state(), robot, 1e-3);
  ASSERT_EQ(overlaps.size(), 1);
  EXPECT_EQ(overlaps[0].second, world.layout().Find("wall"));
}

TEST(Attachment, InvalidAttachmentIsRejected) {
  TestWorld world = GraspScene();
  ASSERT_TRUE(world.Start());
  const auto refuses = [&](int holder, int link, int held) {
    const auto status = world.engine().Attach({holder, link, held, {}}, world.state());
    return !status && status.error().code == base::ErrorCode::kInvalidArgument;
  };
  const int robot = world.layout().Find("robot"), crate = world.layout().Find("crate"),
            wall = world.layout().Find("wall"), other = world.layout().Find("other");
  EXPECT_TRUE(refuses(-1, 0, crate));
  EXPECT_TRUE(refuses(robot, 0, static_cast<int>(world.layout().bodies.size())));
  EXPECT_TRUE(refuses(robot, 1, crate));
  EXPECT_TRUE(refuses(robot, 0, wall));
  EXPECT_TRUE(refuses(wall, 0, crate));
  EXPECT_TRUE(refuses(crate, 0, crate));
  ASSERT_TRUE(world.engine().Attach({robot, 0, crate, {}}, world.state()));
  EXPECT_TRUE(refuses(robot, 0, crate));
  EXPECT_TRUE(refuses(crate, 0, other));
}

}  // namespace
}  // namespace gsv::dynamics
