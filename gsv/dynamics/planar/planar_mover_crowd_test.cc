// Tests crowds. Many robots, several threads and the caches of the mover must not change the
// result.

#include <algorithm>
#include <atomic>

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
    // Before every third step, the engine steps a copy of the state in which all robots are
    // elsewhere (0.1 m or 30 m away). This changes its caches.
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

// Records the calls of Engine::StepMany(). Each planar body must move by each step once, in order.
class StepCounter final : public MotionFollower {
 public:
  explicit StepCounter(std::size_t bodies, int steps) : left_(bodies, steps) {}
  void OnMoved(int body, int steps, int steps_left, bool may_touch) override {
    int& left = left_[static_cast<std::size_t>(body)];
    is_in_order_ = is_in_order_ && steps_left == left - steps;
    left = steps_left;
    if (may_touch && steps_left == 0) ++near_;
  }
  bool HasMovedAll(const std::vector<std::size_t>& bodies) const {
    return is_in_order_ && std::all_of(bodies.begin(), bodies.end(),
                                       [&](std::size_t body) { return left_[body] == 0; });
  }
  int near() const { return near_; }

 private:
  std::vector<int> left_;
  std::atomic<bool> is_in_order_ = true;
  int near_ = 0;
};

// A robot with wheels of different sizes that slip.
std::shared_ptr<model::Model> SlippingRobot() {
  auto robot = testing::BoxRobot(0.3, 0.3);
  for (const double y : {0.15, -0.15}) {
    model::Joint wheel;
    wheel.kind = model::JointKind::kContinuous;
    wheel.model_from_joint.position = {0.05, y, 0.05};
    wheel.axis = {0, 1, 0};
    (y > 0 ? robot->drive->left_wheels : robot->drive->right_wheels)
        .push_back(static_cast<int>(robot->joints.size()));
    wheel.child = 0;
    robot->joints.push_back(wheel);
  }
  robot->drive->wheel_radius = 0.05;
  robot->drive->right_wheel_scale = 1.05;
  robot->drive->slip = {0.1, 0.2};
  return robot;
}

// A robot that can slide and needs some time to change its speed. It stops 0.3 s after a command.
std::shared_ptr<model::Model> SlowlySlidingRobot() {
  auto robot = testing::RobotOf(geometry::Box{{0.3, 0.2, 0.4}}, 0.4, model::DriveKind::kVelocity);
  robot->drive->linear_acceleration = {-1, 2};
  robot->drive->angular_acceleration = {-3, 3};
  robot->drive->command_timeout = std::chrono::milliseconds(300);
  return robot;
}

// Compares StepMany() with single steps of another engine, over and over.
void ExpectManyStepsToEqualSingleSteps(const std::shared_ptr<const model::Model>& robot,
                                       int threads) {
  Crowd single(200, robot, MakeWorldEngine());
  Crowd many(200, robot, MakeWorldEngine(std::make_shared<base::ThreadTeam>(threads)));
  ASSERT_TRUE(single.Start() && many.Start());
  const base::SimTime step = base::FromSeconds(Crowd::kStep);
  std::size_t at_once = 0, near = 0, contacts_in_many = 0;
  for (int round = 0; round < 500; ++round) {
    const int steps = 2 + round % 7;
    for (Crowd* crowd : {&single, &many}) {
      world::State& state = crowd->world().state();
      for (int i = 0; i < steps; ++i, ++state.step) crowd->Decide();
      state.step -= steps;
    }
    std::vector<world::Contact> contacts, expected_contacts;
    for (int i = 0; i < steps; ++i) single.world().Step(step, expected_contacts);
    world::State& state = many.world().state();
    StepCounter counter(state.bodies.size(), steps);
    if (many.world().engine().StepMany(step, steps, state, contacts, counter)) {
      ASSERT_TRUE(counter.HasMovedAll(many.robots())) << round;
      state.step += steps;
      state.time += steps * step;
      ++at_once;
      near += static_cast<std::size_t>(counter.near());
      contacts_in_many += contacts.size();
    } else {
      for (int i = 0; i < steps; ++i) many.world().Step(step, contacts);
    }
    base::Hash expected, actual;
    world::AddToHash(single.world().layout(), single.world().state(), expected);
    world::AddToHash(many.world().layout(), state, actual);
    AddContacts(expected_contacts, expected);
    AddContacts(contacts, actual);
    ASSERT_EQ(actual.Digest(), expected.Digest()) << round;
  }
  EXPECT_GT(at_once, 100u);
  EXPECT_GT(near, 1000u);
  EXPECT_GT(contacts_in_many, 100u);
}

TEST(PlanarMoverCrowd, ManyStepsAtOnceEqualSingleSteps) {
  for (const int threads : {1, 2}) {
    ExpectManyStepsToEqualSingleSteps(testing::DiscRobot(0.175), threads);
    ExpectManyStepsToEqualSingleSteps(SlowlySlidingRobot(), threads);
    ExpectManyStepsToEqualSingleSteps(SlippingRobot(), threads);
  }
}

// Two robots are too far apart to touch in one step, and meet in the middle of several steps.
TEST(PlanarMoverCrowd, RobotsMeetWithinManySteps) {
  testing::TestWorld world(MakeWorldEngine());
  for (int i = 0; i < 12; ++i) {
    world.AddRobot("robot" + std::to_string(i), testing::DiscRobot(0.2),
                   geometry::PlanarPose(i * 3, 0, 0, 0));
  }
  world.AddRobot("s", testing::DiscRobot(0.2), geometry::PlanarPose(0.45, 0, 0, 3.14159));
  ASSERT_TRUE(world.Start());
  std::vector<world::Contact> contacts;
  world.Step(base::FromSeconds(0.01), contacts);
  world::State& state = world.state();
  for (const std::string name : {"robot0", "s"}) {
    state.bodies[world.layout().Find(name)].drive.command = {1, 0, 0};
  }
  StepCounter counter(state.bodies.size(), 8);
  ASSERT_TRUE(world.engine().StepMany(base::FromSeconds(0.01), 8, state, contacts, counter));
  // The gap between the two robots is 50 mm, so each of them moves by 25 mm. This takes two and a
  // half of the eight steps.
  ASSERT_EQ(contacts.size(), 1u);
  EXPECT_EQ(state.bodies[world.layout().Find("robot0")].collisions, 1u);
  EXPECT_NEAR(state.bodies[world.layout().Find("robot0")].world_from_model.position.x, 0.025, 1e-5);
  EXPECT_NEAR(state.bodies[world.layout().Find("s")].world_from_model.position.x, 0.425, 1e-5);
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
