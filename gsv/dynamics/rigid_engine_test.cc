// Tests WorldEngine with a simple rigid-body engine in the place of the project's own.
#include <gtest/gtest.h>

#include "gsv/dynamics/testing/test_rigid_world.h"

namespace gsv::dynamics {
namespace {

using testing::At;
using testing::TestWorld;

struct StepCount final : world::EngineState {
  explicit StepCount(std::int64_t n) : steps(n) {}
  void AddToHash(base::Hash& hash) const override { hash.Add(steps); }
  const std::int64_t steps;
};

// An engine in which bodies fall without touching anything. A pushed body slides at half the speed
// of the push. The state counts its steps.
class FallingEngine final : public RigidEngine {
 public:
  base::Status SetLayout(std::shared_ptr<const world::Layout> layout) override {
    layout_ = std::move(layout);
    return {};
  }

  bool has_bodies() const override {
    return std::any_of(layout_->bodies.begin(), layout_->bodies.end(),
                       [](const world::Body& body) { return body.is_rigid(); });
  }

  void Step(base::SimTime step, const world::State& before, std::span<Push> pushes,
            world::State& state, std::vector<world::Contact>& contacts) override {
    const double h = base::ToSeconds(step);
    for (std::size_t i = 0; i < state.bodies.size(); ++i) {
      if (!layout_->bodies[i].is_rigid()) continue;
      world::BodyState& body = state.bodies[i];
      const geometry::Vector3 gravity = layout_->description->gravity;
      body.world_from_model.position += h * body.linear_velocity + (h * h / 2) * gravity;
      body.linear_velocity += h * gravity;
    }
    contacts.clear();
    for (Push& push : pushes) {
      push.achieved = push.speed / 2;
      push.impulse = 0.25;
      state.bodies[push.object].world_from_model.position += (h * push.achieved) * push.normal;
    }
    const auto* const kept = dynamic_cast<const StepCount*>(before.engine.get());
    state.engine = std::make_shared<StepCount>(kept == nullptr ? 1 : kept->steps + 1);
  }

  std::vector<world::Contact> OverlapsOf(const world::State&, int, double) override { return {}; }

 private:
  std::shared_ptr<const world::Layout> layout_;
};

std::shared_ptr<model::Model> SmallBox() {
  return testing::SolidOf(geometry::Box{{0.2, 0.2, 0.2}}, 1);
}

TestWorld FallingWorld() {
  return TestWorld(MakeWorldEngine(nullptr, std::make_unique<FallingEngine>()));
}

TEST(RigidEngine, MovesTheRigidBodiesOfAWorld) {
  TestWorld world = FallingWorld();
  world.AddRigid("box", SmallBox(), At(0, 0, 10));
  ASSERT_TRUE(world.Start());
  world.Run(1, 0.01);
  EXPECT_NEAR(world.position("box").z, 10 - testing::kG / 2, 1e-9);
}

TEST(RigidEngine, StoresItsDataInTheHashedState) {
  TestWorld world = FallingWorld();
  world.AddRigid("box", SmallBox(), At(0, 0, 10));
  ASSERT_TRUE(world.Start());
  world.Run(0.03, 0.01);
  ASSERT_NE(world.state().engine, nullptr);
  EXPECT_EQ(dynamic_cast<const StepCount&>(*world.state().engine).steps, 3);
  const std::uint64_t digest = world.Digest();
  world.state().engine = nullptr;
  EXPECT_NE(world.Digest(), digest);
}

TEST(RigidEngine, ReturnsTheSpeedOfAPush) {
  TestWorld world = FallingWorld();
  world.AddRobot("robot", testing::DiscRobot(), {});
  world.AddRigid("box", SmallBox(), At(0.31, 0, 0.2));
  ASSERT_TRUE(world.Start());
  world.Command("robot", {0.5, 0, 0});
  std::vector<world::Contact> contacts;
  for (int i = 0; i < 5; ++i) contacts = world.Step(0.01);
  EXPECT_NEAR(world.body("robot").drive.actual.linear, 0.25, 1e-9);
  ASSERT_EQ(contacts.size(), 1u);
  EXPECT_EQ(contacts[0].impulse, 0.25);
}

}  // namespace
}  // namespace gsv::dynamics
