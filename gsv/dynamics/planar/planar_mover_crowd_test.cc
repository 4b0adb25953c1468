// Tests crowds. Many robots, several threads and the caches of the mover must not change the
// result.

#include <algorithm>

#include <gtest/gtest.h>

#include "gsv/dynamics/testing/test_crowd.h"
#include "gsv/dynamics/world_engine.h"

namespace gsv::dynamics {
namespace {

using testing::Crowd;

constexpr double kDense = 1.9;  // area of the floor per robot, m²

void AddContacts(const std::vector<world::Contact>& contacts, base::Hash& hash) {
  for (const world::Contact& c : contacts) {
    hash.Add(std::int64_t{c.first});
    hash.Add(std::int64_t{c.second});
    hash.Add(c.point.x);
    hash.Add(c.point.y);
    hash.Add(c.depth);
    hash.Add(std::int64_t{c.began});
  }
}

// The crowd's digest after each kInterval steps.
constexpr int kInterval = 100;
std::vector<std::uint64_t> DigestsOfRun(const std::shared_ptr<const model::Model>& robot, int steps,
                                        std::shared_ptr<base::ThreadTeam> team) {
  Crowd crowd(700, robot, MakeWorldEngine(std::move(team)), kDense);
  EXPECT_TRUE(crowd.Start());
  std::vector<std::uint64_t> digests;
  base::Hash hash;
  std::size_t contacts = 0;
  for (int i = 1; i <= steps; ++i) {
    contacts += crowd.Step();
    AddContacts(crowd.contacts(), hash);
    if (i % kInterval != 0) continue;
    world::AddToHash(crowd.world().layout(), crowd.world().state(), hash);
    digests.push_back(hash.Digest());
  }
  EXPECT_GT(contacts, 2u * steps);
  return digests;
}

TEST(PlanarMoverCrowd, IsEqualForAnyNumberOfThreads) {
  const auto sliding =
      testing::RobotOf(geometry::Box{{0.3, 0.2, 0.4}}, 0.4, model::DriveKind::kVelocity);
  const auto expect_same = [](const auto& robot, int longest) {
    const auto alone = DigestsOfRun(robot, longest, nullptr);
    // With many threads, the test runs few steps: steps are slow if there are more threads than
    // processors.
    for (const auto& [threads, steps] : {std::pair{1, 300}, {2, 2000}, {3, 300}, {7, 100}}) {
      const auto together = DigestsOfRun(robot, std::min(steps, longest),
                                         std::make_shared<base::ThreadTeam>(threads));
      EXPECT_TRUE(std::equal(together.begin(), together.end(), alone.begin())) << threads;
    }
  };
  expect_same(testing::DiscRobot(0.175), 2000);
  expect_same(sliding, 300);
}

// A mover caches data between steps to avoid searches. A mover with an empty cache, or with a
// different cache, must compute the same step.
TEST(PlanarMoverCrowd, CachesDoNotChangeTheResult) {
  Crowd crowd(150, testing::BoxRobot(0.3, 0.2), MakeWorldEngine(), kDense);
  ASSERT_TRUE(crowd.Start());
  for (int i = 0; i < 400; ++i) {
    crowd.Decide();
    world::State copy = crowd.world().state();
    const auto fresh = MakeWorldEngine();
    ASSERT_TRUE(fresh->SetLayout(std::make_shared<world::Layout>(crowd.world().layout())));
    // Before every third step, all movers are placed elsewhere, near or far.
    if (i % 3 == 0) {
      world::State elsewhere = copy;
      for (const std::size_t robot : crowd.robots()) {
        elsewhere.bodies[robot].world_from_model.position.x += i % 2 ? 0.1 : 30;
      }
      std::vector<world::Contact> ignored;
      crowd.world().engine().Step(base::FromSeconds(Crowd::kStep), elsewhere, ignored);
    }
    std::vector<world::Contact> contacts, expected_contacts;
    crowd.world().Step(base::FromSeconds(Crowd::kStep), contacts);
    fresh->Step(base::FromSeconds(Crowd::kStep), copy, expected_contacts);
    copy.time = crowd.world().state().time;
    copy.step = crowd.world().state().step;
    base::Hash expected, actual;
    world::AddToHash(crowd.world().layout(), copy, expected);
    world::AddToHash(crowd.world().layout(), crowd.world().state(), actual);
    AddContacts(expected_contacts, expected);
    AddContacts(contacts, actual);
    ASSERT_EQ(actual.Digest(), expected.Digest()) << i;
  }
}

TEST(PlanarMoverCrowd, OverlapsOfABodyAreASubsetOfAllOverlaps) {
  Crowd crowd(150, testing::BoxRobot(0.3, 0.2), MakeWorldEngine(), kDense);
  ASSERT_TRUE(crowd.Start());
  for (int i = 0; i < 300; ++i) crowd.Step();
  world::State state = crowd.world().state();
  // Moves some robots into other robots and into boxes.
  for (std::size_t i = 0; i < crowd.robots().size(); i += 3) {
    state.bodies[crowd.robots()[i]].world_from_model.position.x += 0.3;
  }
  Engine& engine = crowd.world().engine();
  const auto all = engine.Overlaps(state, 1e-3);
  ASSERT_GT(all.size(), 10u);
  for (int body = 0; body < static_cast<int>(state.bodies.size()); ++body) {
    std::vector<world::Contact> expected;
    std::copy_if(all.begin(), all.end(), std::back_inserter(expected),
                 [&](const world::Contact& c) { return c.first == body || c.second == body; });
    base::Hash a, b;
    AddContacts(expected, a);
    AddContacts(engine.OverlapsOf(state, body, 1e-3), b);
    ASSERT_EQ(b.Digest(), a.Digest()) << crowd.world().layout().bodies[body].name;
  }
}

}  // namespace
}  // namespace gsv::dynamics
