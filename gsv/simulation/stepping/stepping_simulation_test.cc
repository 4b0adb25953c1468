#include "gsv/simulation/stepping/stepping_simulation.h"

#include <future>

#include "gsv/dynamics/world_engine.h"
#include "gsv/simulation/testing/test_simulation.h"

namespace gsv::simulation {
namespace {

// Wraps the world's engine and calls a function before each new layout.
class ObservedEngine final : public dynamics::Engine {
 public:
  base::Status SetLayout(std::shared_ptr<const world::Layout> layout) override {
    if (before_layout) before_layout();
    return engine_->SetLayout(std::move(layout));
  }
  base::Status Attach(const dynamics::Attachment& attachment, const world::State& state) override {
    return engine_->Attach(attachment, state);
  }
  void Detach(int held_body) override { engine_->Detach(held_body); }
  void Step(base::SimTime step, world::State& state,
            std::vector<world::Contact>& contacts) override {
    engine_->Step(step, state, contacts);
    ++steps;
  }
  bool StepMany(base::SimTime step, int count, world::State& state,
                std::vector<world::Contact>& contacts,
                dynamics::MotionFollower& follower) override {
    if (!engine_->StepMany(step, count, state, contacts, follower)) return false;
    at_once.push_back(count);
    return true;
  }
  std::vector<world::Contact> Overlaps(const world::State& state, double tolerance) override {
    return engine_->Overlaps(state, tolerance);
  }
  std::vector<world::Contact> OverlapsOf(const world::State& state, int body,
                                         double tolerance) override {
    return engine_->OverlapsOf(state, body, tolerance);
  }

  std::function<void()> before_layout;
  int steps = 0;             // single steps
  std::vector<int> at_once;  // numbers of steps that were taken at once

 private:
  const std::unique_ptr<dynamics::Engine> engine_ = dynamics::MakeWorldEngine();
};

// An observer that does nothing. With an observer, the simulation takes single steps.
class IdleObserver final : public Observer {
 public:
  void OnSnapshot(const std::shared_ptr<const world::Snapshot>& /*snapshot*/) override {}
  void OnEvent(const Event& /*event*/) override {}
};

// The result of a run of nine robots. Eight robots drive, and their behaviours wake every 50 ms.
// The first of them collides with the ninth robot, which stands still.
struct RunResult {
  std::string hash;
  std::vector<int> at_once;
  int steps = 0;
  std::uint64_t collisions = 0;
  std::vector<double> accelerations;  // of all bodies along x, at the end of the run
};

RunResult RunEightRobots(SimTime duration, const std::shared_ptr<Observer>& observer) {
  Specification specification = Lockstep(duration);
  specification.step = 10ms;
  auto layout = world::MakeLayout(1, {}, specification.world);
  auto owned = std::make_unique<ObservedEngine>();
  ObservedEngine& engine = *owned;
  EXPECT_TRUE(engine.SetLayout(layout));
  auto sensors = std::make_shared<sensing::SensorRegistry>();
  sensing::AddBuiltInSensors(*sensors);
  SteppingSimulation simulation(std::move(specification), std::move(sensors),
                                std::make_shared<base::ThreadTeam>(2), std::move(owned),
                                std::move(layout));
  if (observer != nullptr) simulation.AddObserver(observer);
  for (int i = 0; i < 8; ++i) {
    EXPECT_TRUE(simulation.AddRobot(Robot("robot" + std::to_string(i), 0, 2 * i, Drives(1 + i))));
  }
  EXPECT_TRUE(simulation.AddRobot(Robot("stands", 2, 0)));
  RunResult result;
  EXPECT_EQ(RunToEnd(simulation), Phase::kFinished);
  EXPECT_EQ(simulation.status().step, duration / 10ms);
  result.hash = simulation.state_hash();
  result.at_once = engine.at_once;
  result.steps = engine.steps;
  for (const RobotStatus& robot : simulation.status().robots) result.collisions += robot.collisions;
  for (const world::Acceleration& each : simulation.snapshot()->accelerations) {
    result.accelerations.push_back(each.linear.x);
  }
  return result;
}

TEST(SteppingSimulation, TakesManyStepsAtOnceWithoutObservers) {
  const RunResult alone = RunEightRobots(3s, nullptr);
  const RunResult observed = RunEightRobots(3s, std::make_shared<IdleObserver>());
  EXPECT_TRUE(observed.at_once.empty());
  EXPECT_EQ(observed.steps, 300);
  EXPECT_EQ(alone.steps, 1);  // this step prepares the obstacles for StepMany()
  std::vector<int> until_they_wake(60, 5);
  until_they_wake.front() = 4;
  EXPECT_EQ(alone.at_once, until_they_wake);
  EXPECT_EQ(alone.hash, observed.hash);
  EXPECT_EQ(alone.collisions, 2u);  // each of the two robots counts the contact
  EXPECT_EQ(alone.collisions, observed.collisions);
}

// All robots start to move in the first step of the run. At the end of the run, their accelerations
// must be those of the last step, not the mean over all steps.
TEST(SteppingSimulation, AccelerationsOfManyStepsAreThoseOfTheLastStep) {
  for (const SimTime duration : {10ms, 20ms, 50ms}) {
    EXPECT_EQ(RunEightRobots(duration, nullptr).accelerations,
              RunEightRobots(duration, std::make_shared<IdleObserver>()).accelerations)
        << duration.count();
  }
}

// The robot has no behaviour, so no agent wakes and limits the number of steps at once.
// Nevertheless, the run must pause at the requested step.
TEST(SteppingSimulation, ManyStepsEndAtTheRequestedInstant) {
  const auto simulation = Make(Lockstep(1s));
  ASSERT_TRUE(simulation->AddRobot(Robot("robot", 0, 0)));
  const auto await_pause = [&] {
    return simulation->WaitForPhase({Phase::kPaused, Phase::kFinished}, kTimeout);
  };
  ASSERT_TRUE(simulation->Step(3));
  EXPECT_EQ(await_pause(), Phase::kPaused);
  EXPECT_EQ(simulation->status().step, 3);
  ASSERT_TRUE(simulation->RunUntil(65ms));
  EXPECT_EQ(await_pause(), Phase::kPaused);
  EXPECT_EQ(simulation->status().step, 7);
  ASSERT_TRUE(simulation->Resume());
  EXPECT_EQ(simulation->WaitForPhase({Phase::kFinished}, kTimeout), Phase::kFinished);
  EXPECT_EQ(simulation->status().step, 100);
}

TEST(SteppingSimulation, AnswersAgentsWhileItsEngineLoadsALayout) {
  Specification specification = Lockstep(0s);
  specification.step = 10ms;
  auto layout = world::MakeLayout(1, {}, specification.world);
  auto owned = std::make_unique<ObservedEngine>();
  ObservedEngine& engine = *owned;
  ASSERT_TRUE(engine.SetLayout(layout));
  auto sensors = std::make_shared<sensing::SensorRegistry>();
  sensing::AddBuiltInSensors(*sensors);
  SteppingSimulation simulation(std::move(specification), std::move(sensors),
                                std::make_shared<base::ThreadTeam>(1), std::move(owned),
                                std::move(layout));
  ASSERT_TRUE(simulation.AddRobot(Robot("stays", 0, 0)));
  ASSERT_TRUE(simulation.AddRobot(Robot("goes", 1, 0)));
  const auto agent = simulation.agent("stays");
  int answers = 0;
  engine.before_layout = [&] {
    auto now = std::async(std::launch::async, [&] { return agent->Now(); });
    EXPECT_EQ(now.wait_for(kTimeout), std::future_status::ready);
    ++answers;
  };
  ASSERT_TRUE(simulation.RemoveRobot("goes"));
  EXPECT_GT(std::exchange(answers, 0), 0);
  ASSERT_TRUE(simulation.AddRobot(Robot("comes", 1, 0)));
  EXPECT_GT(std::exchange(answers, 0), 0);
  ASSERT_TRUE(simulation.PlaceBody("comes", PlanarPose(2, 0, 0, 0), true));
  EXPECT_GT(answers, 0);
}

}  // namespace
}  // namespace gsv::simulation
