// Tests that bodies which do not touch have no effect on each other: results are bit-identical.
#include <cmath>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include "gsv/dynamics/testing/test_rigid_world.h"

namespace gsv::dynamics::islands {
namespace {

using testing::At;
using testing::SolidOf;
using testing::TestWorld;

constexpr double kStep = 1e-3;  // s

// A plate on four wheels. The wheels rotate the plate about its centre, so all of them slip.
std::shared_ptr<model::Model> Rover() {
  auto model = SolidOf(geometry::Box{{0.6, 0.4, 0.1}}, 10);
  for (const double x : {-0.2, 0.2}) {
    for (const double y : {-0.25, 0.25}) {
      model::Link link = SolidOf(geometry::Cylinder{0.1, 0.06}, 1)->links[0];
      link.name = "wheel" + std::to_string(model->links.size());
      link.model_from_link = {{x, y, -0.05}, geometry::FromAxisAngle({1, 0, 0}, std::asin(1))};
      model->links.push_back(link);
      model::Joint joint;
      joint.name = link.name;
      joint.kind = model::JointKind::kContinuous;
      joint.parent = 0;
      joint.child = static_cast<int>(model->links.size()) - 1;
      joint.model_from_joint = At(x, y, -0.05);
      joint.axis = {0, 1, 0};
      joint.effort_limit = 5;
      model->joints.push_back(joint);
    }
  }
  return model;
}

// A rover that pushes a box, and another box that slides. `far_bodies` more bodies fall and come to
// rest 20 m away.
TestWorld WorldWith(int far_bodies, int threads = 1) {
  TestWorld world(MakeWorldEngine(std::make_shared<base::ThreadTeam>(threads)));
  world.AddStatic("ground", testing::GroundOf(), {});
  world.AddRigid("rover", Rover(), At(0, 0, 0.15));
  world.AddRigid("pushed", SolidOf(geometry::Box{{0.3, 0.3, 0.3}}, 1), At(0.5, 0.02, 0.15));
  world.AddRigid("sliding", SolidOf(geometry::Box{{0.3, 0.2, 0.1}}, 1), At(-3, 0, 0.05));
  for (int i = 0; i < far_bodies; ++i) {
    world.AddRigid("far" + std::to_string(i), SolidOf(geometry::Box{{0.2, 0.2, 0.2}}, 1),
                   At(20 + 0.05 * (i % 3), 0.03 * (i % 5), 0.15 + 0.22 * i));
  }
  EXPECT_TRUE(world.Start());
  world.body("sliding").linear_velocity = {0, 2, 0};
  for (int wheel = 0; wheel < 4; ++wheel) {
    world.CommandJoint("rover", wheel,
                       {world::JointCommand::Kind::kVelocity, wheel % 2 == 0 ? 5.0 : 3.0});
  }
  return world;
}

void ExpectTheSame(TestWorld& a, TestWorld& b, const std::string& name) {
  const world::BodyState &x = a.body(name), &y = b.body(name);
  EXPECT_EQ(x.world_from_model.position, y.world_from_model.position) << name;
  EXPECT_EQ(x.linear_velocity, y.linear_velocity) << name;
  EXPECT_EQ(x.angular_velocity, y.angular_velocity) << name;
}

TEST(Islands, BodiesFarAwayHaveNoEffect) {
  TestWorld alone = WorldWith(0);
  for (const int far_bodies : {1, 30}) {
    TestWorld crowded = WorldWith(far_bodies);
    alone = WorldWith(0);
    for (int i = 0; i < 600; ++i) {
      alone.Step(kStep);
      crowded.Step(kStep);
    }
    for (const auto* name : {"rover", "pushed", "sliding"}) ExpectTheSame(alone, crowded, name);
    for (int wheel = 0; wheel < 4; ++wheel) {
      EXPECT_EQ(alone.joint("rover", wheel), crowded.joint("rover", wheel));
    }
  }
  // The rover has pushed its box, and the sliding box has come to rest.
  EXPECT_GT(alone.position("pushed").x, 0.55);
  EXPECT_EQ(alone.body("sliding").linear_velocity, geometry::Vector3{});
}

TEST(Islands, AreEqualForAnyNumberOfThreads) {
  std::vector<std::uint64_t> digests;
  for (const int threads : {1, 2, 3}) {
    TestWorld world(MakeWorldEngine(std::make_shared<base::ThreadTeam>(threads)));
    world.AddStatic("ground", testing::GroundOf(), {});
    for (int i = 0; i < 12; ++i) {
      world.AddRigid("rover" + std::to_string(i), Rover(), At(3 * i, 0, 0.15));
    }
    ASSERT_TRUE(world.Start());
    for (int i = 0; i < 12; ++i) {
      const std::string name = "rover" + std::to_string(i);
      for (int wheel = 0; wheel < 4; ++wheel) {
        world.CommandJoint(name, wheel,
                           {world::JointCommand::Kind::kVelocity, 3.0 + i * (wheel % 2)});
      }
    }
    for (int i = 0; i < 200; ++i) world.Step(kStep);
    EXPECT_GT(std::abs(world.position("rover5").x - 15), 0.02);
    digests.push_back(world.Digest());
  }
  EXPECT_EQ(digests[0], digests[1]);
  EXPECT_EQ(digests[0], digests[2]);
}

}  // namespace
}  // namespace gsv::dynamics::islands
