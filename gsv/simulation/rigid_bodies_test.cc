// Tests rigid-body dynamics in a simulation.
#include <gtest/gtest.h>

#include "gsv/simulation/testing/test_simulation.h"

namespace gsv::simulation {
namespace {

std::shared_ptr<model::Model> ModelOf(const std::string& name, const geometry::Shape& shape) {
  auto model = std::make_shared<model::Model>();
  model->name = name;
  model->links.resize(1);
  model->links[0].collisions.push_back({"shape", {}, shape, {}});
  return model;
}

// A slider: a hand on a prismatic joint to the world, with friction that stops it.
std::shared_ptr<const model::Model> Slider() {
  auto model = ModelOf("slider", geometry::Sphere{0.1});
  model::Joint joint;
  joint.name = "slide";
  joint.kind = model::JointKind::kPrismatic;
  joint.friction = 100;
  model->joints.push_back(joint);
  return model;
}

// A world with a box half a metre above the ground, and a slider that collides with nothing.
Specification WithBox() {
  Specification specification = Lockstep(1s);
  auto world = std::make_shared<model::WorldDescription>(*specification.world);
  world->models.push_back({"ground", ModelOf("ground", geometry::Plane{}), {}, true});
  auto box = ModelOf("box", geometry::Box{{0.4, 0.4, 0.4}});
  world->models.push_back({"box", box, {{-5, -5, 0.7}, {}}, false});
  world->models.push_back({"slider", Slider(), {{-9, -9, 3}, {}}, false});
  specification.world = world;
  return specification;
}

world::BodyState BodyOf(const Simulation& simulation, const std::string& name) {
  const auto snapshot = simulation.snapshot();
  return snapshot->state.bodies[snapshot->layout->Find(name)];
}

TEST(RigidBodies, DynamicBodiesFall) {
  const auto simulation = Make(WithBox());
  EXPECT_EQ(RunToEnd(*simulation), Phase::kFinished);
  EXPECT_NEAR(BodyOf(*simulation, "box").world_from_model.position.z, 0.2, 1e-4);
}

TEST(RigidBodies, ARunAfterAResetEqualsTheFirst) {
  const auto simulation = Make(WithBox());
  RunToEnd(*simulation);
  const std::string first = simulation->state_hash();
  ASSERT_TRUE(simulation->Reset());
  RunToEnd(*simulation);
  EXPECT_EQ(simulation->state_hash(), first);
}

TEST(RigidBodies, AddingAndRemovingAnotherRobotHasNoEffect) {
  const auto alone = Make(WithBox()), visited = Make(WithBox());
  RunToEnd(*alone);
  ASSERT_TRUE(visited->RunUntil(200ms));
  visited->WaitForPhase({Phase::kPaused}, kTimeout);
  ASSERT_TRUE(visited->AddRobot(Robot("visitor", 0, 0)));
  ASSERT_TRUE(visited->RunUntil(400ms));
  visited->WaitForPhase({Phase::kPaused}, kTimeout);
  ASSERT_TRUE(visited->RemoveRobot("visitor"));
  ASSERT_TRUE(visited->Resume());
  visited->WaitForPhase({Phase::kFinished}, kTimeout);
  EXPECT_EQ(visited->state_hash(), alone->state_hash());
}

TEST(RigidBodies, AJointAppliesItsCommand) {
  using Kind = world::JointCommand::Kind;
  const auto simulation = Make(WithBox());
  EXPECT_FALSE(simulation->CommandJoint("box", "slide", {Kind::kPosition, 1}));
  EXPECT_FALSE(simulation->CommandJoint("wall", "slide", {Kind::kPosition, 1}));
  EXPECT_FALSE(simulation->CommandJoint("slider", "slide", {Kind::kPosition, NAN}));
  ASSERT_TRUE(simulation->CommandJoint("slider", "slide", {Kind::kPosition, 0.3}));
  RunToEnd(*simulation);
  EXPECT_NEAR(simulation->snapshot()->state.joint_positions[0], 0.3, 1e-3);
}

}  // namespace
}  // namespace gsv::simulation
