// Tests that simulations place pedestrians, and keep them when the world is edited.
#include <gtest/gtest.h>

#include "gsv/simulation/testing/test_simulation.h"
#include "gsv/world/pedestrian.h"

namespace gsv::simulation {
namespace {

model::PedestrianGroup Walkers(int count, std::vector<model::PedestrianGoal> route) {
  model::PedestrianGroup group;
  group.name = "walker";
  group.count = count;
  group.route = std::move(route);
  return group;
}

// A world with pedestrians who walk around the wall at x = 3, which is 10 m long.
Specification WithWalkers(int count, int threads = 0) {
  Specification specification = Lockstep(2s);
  specification.seed = 3;
  specification.threads = threads;
  specification.pedestrians = {Walkers(count, {{-6, 0, 4}, {8, 0, 4}})};
  return specification;
}

TEST(Pedestrians, StartOnTheirRouteWithoutOverlaps) {
  const auto simulation = Make(WithWalkers(60));
  const auto snapshot = simulation->snapshot();
  const std::vector<world::Body>& bodies = snapshot->layout->bodies;
  std::vector<geometry::Vector3> places;
  for (const world::Body& body : bodies) {
    if (!body.is_pedestrian()) continue;
    const geometry::Vector3& at = body.initial_pose.position;
    EXPECT_TRUE(at.x > -10 && at.x < 12 && std::abs(at.y) < 4) << body.name;
    EXPECT_GE(std::abs(at.x - 3), 0.1 + 0.25 - 1e-3);
    for (const auto& other : places) EXPECT_GE(std::hypot(at.x - other.x, at.y - other.y), 0.5);
    places.push_back(at);
    EXPECT_FALSE(body.is_robot());
  }
  EXPECT_EQ(places.size(), 60u);
  EXPECT_GE(snapshot->layout->Find("walker_60"), 0);
}

TEST(Pedestrians, AreDeterministicForAnyNumberOfThreads) {
  const auto run = [](int threads) {
    const auto simulation = Make(WithWalkers(150, threads));
    EXPECT_EQ(RunToEnd(*simulation), Phase::kFinished);
    return simulation->state_hash();
  };
  const std::string alone = run(1);
  EXPECT_EQ(run(1), alone);
  EXPECT_EQ(run(4), alone);
}

TEST(Pedestrians, AreTheSameAfterAReset) {
  const auto simulation = Make(WithWalkers(20));
  RunToEnd(*simulation);
  const std::string first = simulation->state_hash();
  ASSERT_TRUE(simulation->Reset());
  RunToEnd(*simulation);
  EXPECT_EQ(simulation->state_hash(), first);
}

TEST(Pedestrians, StartDifferentlyForAnotherSeed) {
  Specification other = WithWalkers(5);
  other.seed = 4;
  const auto a = Make(WithWalkers(5)), b = Make(other);
  EXPECT_NE(a->state_hash(), b->state_hash());
}

TEST(Pedestrians, KeepTheirRandomNumbersIfMoreAreAdded) {
  const auto few = Make(WithWalkers(5))->snapshot(), many = Make(WithWalkers(6))->snapshot();
  const auto speed = [](const auto& snapshot, const char* name) {
    return snapshot->layout->bodies[snapshot->layout->Find(name)].pedestrian->speed;
  };
  for (const char* name : {"walker_1", "walker_5"}) EXPECT_EQ(speed(few, name), speed(many, name));
  EXPECT_NE(speed(many, "walker_1"), speed(many, "walker_2"));
}

TEST(Pedestrians, AreRejectedWithoutSpaceOrRoute) {
  Specification crowded = WithWalkers(1);
  crowded.pedestrians = {Walkers(50, {{-6, 0, 0.5}})};
  Specification lost = WithWalkers(1);
  lost.pedestrians = {Walkers(1, {})};
  for (const Specification& specification : {crowded, lost}) {
    auto sensors = std::make_shared<sensing::SensorRegistry>();
    const auto simulation = Simulation::Create(specification, sensors);
    ASSERT_FALSE(simulation);
    EXPECT_EQ(simulation.error().code, base::ErrorCode::kInvalidArgument);
  }
}

TEST(Pedestrians, ContinueWhenARobotIsAdded) {
  const auto simulation = Make(WithWalkers(10));
  ASSERT_TRUE(simulation->AddRobot(Robot("robot", -20, 0)));
  EXPECT_EQ(RunToEnd(*simulation), Phase::kFinished);
  const auto snapshot = simulation->snapshot();
  double farthest = 0;
  for (const world::BodyState& body : snapshot->state.bodies) {
    farthest = std::max(farthest, body.distance);
  }
  EXPECT_GT(farthest, 1);
  EXPECT_EQ(snapshot->state.goals.size(), snapshot->layout->bodies.size());
}

}  // namespace
}  // namespace gsv::simulation
