// Sends start, pause, resume, step, run_until, stop and reset in random order and at random
// moments, and compares the simulation with a model of the life cycle.
#include <random>
#include <thread>

#include <gtest/gtest.h>

#include "gsv/sensing/devices/built_in.h"
#include "gsv/simulation/simulation.h"
#include "gsv/simulation/testing/life_cycle_model.h"

namespace gsv::simulation {
namespace {

using namespace std::chrono_literals;
using namespace life_cycle;

constexpr SimTime kStepSize = 10ms;
constexpr auto kChangeTimeout = 20s;  // wall-clock time limit of every expected change

std::shared_ptr<const model::Model> VelocityDisc() {
  auto model = std::make_shared<model::Model>();
  model->name = "disc";
  model->links.resize(1);
  model->links[0].collisions.push_back(
      {"body", {{0, 0, 0.25}, {}}, geometry::Cylinder{0.2, 0.5}, {}});
  model->drive.emplace();
  model->drive->kind = model::DriveKind::kVelocity;
  return model;
}

// A behaviour that drives in curves, on a thread of this process.
class Curves final : public BehaviourPort {
 public:
  base::Status Init(const std::shared_ptr<Agent>& agent) override {
    agent_ = agent;
    return {};
  }
  base::Status Start() override {
    const auto clock = agent_->OpenClock();
    if (!clock) return base::Fail(clock.error());
    thread_ = std::jthread([agent = agent_, clock = *clock] {
      for (SimTime next = 50ms;; next += 50ms) {
        (void)agent->Command({0.2, 0, next % 200ms == SimTime(0) ? 0.5 : -0.3});
        base::Result<Wait> wait = Wait::kNotYet;
        while (wait && *wait == Wait::kNotYet) wait = agent->SleepUntil(clock, next, 100ms);
        if (!wait) break;
      }
      (void)agent->CloseClock(clock);
    });
    return {};
  }
  base::Status Stop() override {
    if (thread_.joinable()) thread_.join();
    return {};
  }
  base::Status Pause() override { return {}; }
  base::Status Resume() override { return {}; }
  void Destroy() override { agent_.reset(); }
  bool IsDead() override { return false; }
  bool time_managed() const override { return true; }
  const std::string& name() const override { return name_; }
  const std::string& place() const override { return place_; }

 private:
  const std::string name_ = "curves", place_ = "here:1";
  std::shared_ptr<Agent> agent_;
  std::jthread thread_;
};

struct Scene {
  Mode mode = Mode::kLockstep;
  std::int64_t duration = 0;  // number of steps; 0 for a run without end
  int behaviours = 0;
};

std::shared_ptr<Simulation> Make(const Scene& scene) {
  auto world = std::make_shared<model::WorldDescription>();
  world->name = "plain";
  world->max_step_size = kStepSize;
  Specification specification;
  specification.world = world;
  specification.mode = scene.mode;
  specification.factor = 100;
  specification.duration = scene.duration * kStepSize;
  auto sensors = std::make_shared<sensing::SensorRegistry>();
  sensing::AddBuiltInSensors(*sensors);
  auto simulation = *Simulation::Create(std::move(specification), sensors);
  for (int i = 0; i < 2; ++i) {
    RobotSpecification robot;
    robot.model = VelocityDisc();
    robot.world_from_robot = geometry::PlanarPose(0, 2.0 * i, 0, 0);
    if (i < scene.behaviours) robot.behaviour = std::make_shared<Curves>();
    EXPECT_TRUE(simulation->AddRobot(std::move(robot)));
  }
  return simulation;
}

const char* NameOf(Action action) {
  constexpr const char* kNames[] = {"start",     "pause", "resume", "step",
                                    "run_until", "stop",  "reset"};
  return kNames[static_cast<int>(action)];
}

base::Status Perform(Simulation& simulation, const Request& request) {
  switch (request.action) {
    case Action::kStart:
      return simulation.Start();
    case Action::kPause:
      return simulation.Pause();
    case Action::kResume:
      return simulation.Resume();
    case Action::kStep:
      return simulation.Step(request.argument);
    case Action::kRunUntil:
      return simulation.RunUntil(request.argument * kStepSize);
    case Action::kStop:
      return simulation.Stop();
    case Action::kReset:
      return simulation.Reset();
  }
  return {};
}

Observed Observe(const Simulation& simulation) {
  // Reads phase and time together. If they were read separately, a last step could be taken between
  // the two reads. This would look like a pause at the end of the run.
  const SimulationStatus status = simulation.status();
  return {status.phase == Phase::kStarting ? Phase::kRunning : status.phase, status.step};
}

class Dice {
 public:
  explicit Dice(std::uint32_t seed) : engine_(seed) {}
  std::int64_t Below(std::int64_t n) {
    return static_cast<std::int64_t>(engine_() % static_cast<std::uint32_t>(n));
  }

 private:
  std::mt19937 engine_;
};

Scene RandomScene(Dice& dice) {
  Scene scene;
  scene.mode = dice.Below(4) == 0 ? Mode::kRealTime : Mode::kLockstep;
  scene.duration = dice.Below(2) == 0 ? 0 : 1 + dice.Below(dice.Below(2) == 0 ? 4 : 120);
  scene.behaviours = static_cast<int>(dice.Below(3));
  return scene;
}

Request RandomRequest(Dice& dice, std::int64_t step) {
  static constexpr Action kFrequent[] = {Action::kStart,    Action::kPause, Action::kResume,
                                         Action::kStep,     Action::kPause, Action::kResume,
                                         Action::kRunUntil, Action::kStep,  Action::kRunUntil,
                                         Action::kStart,    Action::kReset, Action::kStop};
  const Action action = kFrequent[dice.Below(std::size(kFrequent))];
  if (action == Action::kStep) return {action, dice.Below(12)};
  // A quarter of the requests kRunUntil are for the instant 0, which is usually past.
  if (action == Action::kRunUntil && dice.Below(4) == 0) return {action, 0};
  if (action == Action::kRunUntil) return {action, step + 1 + dice.Below(40)};
  return {action, 0};
}

constexpr auto kRest = {Phase::kCreated, Phase::kPaused, Phase::kStopped, Phase::kFinished,
                        Phase::kFailed};

// Returns the state hash of a new simulation after `steps` steps, which must not exceed its
// duration.
std::string HashAfter(Simulation& simulation, std::int64_t steps) {
  EXPECT_TRUE(simulation.RunUntil(steps * kStepSize));
  EXPECT_EQ(simulation.WaitForPhase({Phase::kPaused}, kChangeTimeout), Phase::kPaused);
  return simulation.state_hash();
}

std::string PlayOneSequence(std::uint32_t seed) {
  Dice dice(seed);
  const Scene scene = RandomScene(dice);
  auto simulation = Make(scene);
  LifeCycleModel model(scene.duration);
  std::string story;
  for (int i = 0; i < 14; ++i) {
    const Observed before = Observe(*simulation);
    const Request request = RandomRequest(dice, before.step);
    const base::Status answer = Perform(*simulation, request);
    story += std::string(" ") + NameOf(request.action) + "(" + std::to_string(request.argument) +
             ")" + (answer ? "" : "!");
    if (!model.Requested(request, before, answer.has_value())) {
      return story + ": the answer to the last request fits no state: " +
             (answer ? "accepted" : answer.error().Sentence());
    }
    if (dice.Below(2) == 0 && model.WillPause()) {
      simulation->WaitForPhase(kRest, kChangeTimeout);
      model.RequirePaused();
      story += " settle";
    }
    const Observed seen = Observe(*simulation);
    if (!model.Seen(seen)) {
      return story + ": phase " + ToString(seen.phase) + " at step " + std::to_string(seen.step) +
             " fits no state";
    }
  }
  if (scene.mode != Mode::kLockstep || (scene.duration > 0 && scene.duration <= 20)) return {};
  if (!simulation->Reset()) return story + ": the last reset was refused";
  if (HashAfter(*simulation, 20) != HashAfter(*Make(scene), 20))
    return story + ": after the last reset the run is not as after a fresh start";
  return {};
}

TEST(LifeCycleProperty, EverySequenceOfRequestsFitsTheModel) {
  for (std::uint32_t seed = 1; seed <= 300; ++seed) {
    const std::string problem = PlayOneSequence(seed);
    ASSERT_EQ(problem, "") << "seed " << seed;
  }
}

// Several threads send requests at the same time. Nothing may block forever, and the simulation
// must stay usable.
TEST(LifeCycleProperty, RequestsFromSeveralThreadsLeaveItUsable) {
  const Scene scene{.mode = Mode::kLockstep, .duration = 0, .behaviours = 2};
  const std::string fresh = HashAfter(*Make(scene), 20);
  for (std::uint32_t round = 1; round <= 20; ++round) {
    auto simulation = Make(scene);
    std::vector<std::jthread> threads;
    for (std::uint32_t thread = 1; thread <= 3; ++thread) {
      threads.emplace_back([&, dice = Dice(round * 100 + thread)]() mutable {
        for (int i = 0; i < 12; ++i)
          (void)Perform(*simulation, RandomRequest(dice, simulation->status().step));
      });
    }
    threads.clear();
    ASSERT_TRUE(simulation->Reset());
    ASSERT_EQ(HashAfter(*simulation, 20), fresh) << "round " << round;
  }
}

}  // namespace
}  // namespace gsv::simulation
