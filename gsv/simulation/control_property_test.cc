// Start, pause, resume, step, run_until, stop and reset in random order and at random moments,
// against a model of the life cycle. The run goes on by itself meanwhile, so the model holds every
// state that the simulation may be in; what is answered and seen must fit one of them.
#include <algorithm>
#include <atomic>
#include <limits>
#include <optional>
#include <random>
#include <thread>

#include <gtest/gtest.h>

#include "gsv/simulation/simulation.h"

namespace gsv::simulation {
namespace {

using namespace std::chrono_literals;

constexpr SimTime kStepSize = 10ms;
constexpr auto kPatience = 20s;  // wall time in which every expected change must have come
constexpr std::int64_t kUnbounded = std::numeric_limits<std::int64_t>::max();

std::shared_ptr<const model::Model> Disc() {
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
  std::int64_t duration = 0;  // steps; 0: until stopped
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
    robot.model = Disc();
    robot.world_from_robot = geometry::PlanarPose(0, 2.0 * i, 0, 0);
    if (i < scene.behaviours) robot.behaviour = std::make_shared<Curves>();
    EXPECT_TRUE(simulation->AddRobot(std::move(robot)));
  }
  return simulation;
}

enum class Action { kStart, kPause, kResume, kStep, kRunUntil, kStop, kReset };

struct Request {
  Action action;
  std::int64_t argument = 0;  // kStep: how many; kRunUntil: the step that its instant falls on
};

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

// What was seen: kStarting counts as running.
struct Sight {
  Phase phase;
  std::int64_t step;
};

Sight Look(const Simulation& simulation) {
  // The phase first: once it says paused, the step that is read after it is the last one.
  const Phase phase = simulation.status().phase;
  return {phase == Phase::kStarting ? Phase::kRunning : phase, simulation.status().step};
}

struct Interval {
  std::int64_t low = 0, high = 0;
};

// One state that the simulation may be in.
struct State {
  Phase phase = Phase::kCreated;
  Interval step;                    // of the latest snapshot
  std::optional<Interval> counted;  // running: where the steps asked for end
  std::optional<std::int64_t> run_until;

  // Where a run ends by itself in a pause.
  std::optional<Interval> Goal() const {
    if (!run_until) return counted;
    if (!counted) return Interval{*run_until, *run_until};
    return Interval{std::min(counted->low, *run_until), std::min(counted->high, *run_until)};
  }
};

State Frozen(Phase phase, Interval step) {
  return {.phase = phase, .step = step, .counted = {}, .run_until = {}};
}

class LifeCycle {
 public:
  explicit LifeCycle(std::int64_t duration) : end_(duration > 0 ? duration : kUnbounded) {}

  // `seen` was seen just before the request, `ok` was its answer. False: no state allows that.
  bool Requested(const Request& request, const Sight& seen, bool ok) {
    std::vector<State> next;
    for (const State& state : WithWhatComesByItself()) {
      if (ok) {
        if (const auto after = After(state, request, seen)) next.push_back(*after);
      } else if (MayBeRefused(state, request)) {
        next.push_back(state);
      }
    }
    states_ = std::move(next);
    return !states_.empty();
  }

  bool Seen(const Sight& seen) {
    std::vector<State> next;
    for (State state : WithWhatComesByItself()) {
      if (state.phase != seen.phase || seen.step < state.step.low || seen.step > state.step.high)
        continue;
      state.step.low = seen.step;
      // The step that was under way when a pause or stop came is the last one.
      if (state.phase != Phase::kRunning)
        state.step.high = std::min(state.step.high, seen.step + 1);
      next.push_back(state);
    }
    states_ = std::move(next);
    return !states_.empty();
  }

  // Whether it comes to rest by itself, whatever it does now.
  bool Settles() const {
    return std::all_of(states_.begin(), states_.end(), [this](const State& state) {
      return state.phase != Phase::kRunning || state.Goal() || end_ != kUnbounded;
    });
  }
  void HasSettled() {
    std::vector<State> settled;
    for (const State& state : WithWhatComesByItself()) {
      if (state.phase != Phase::kRunning) settled.push_back(state);
    }
    states_ = std::move(settled);
  }

 private:
  std::vector<State> WithWhatComesByItself() const {
    std::vector<State> all = states_;
    for (const State& state : states_) {
      if (state.phase != Phase::kRunning) continue;
      const auto goal = state.Goal();
      if (goal && goal->low < end_) {
        const std::int64_t last = std::min(goal->high, end_ - 1);
        all.push_back(Frozen(Phase::kPaused, {std::max(goal->low, state.step.low), last}));
      }
      if (end_ != kUnbounded && (!goal || goal->high >= end_))
        all.push_back(Frozen(Phase::kFinished, {end_, end_}));
    }
    return all;
  }

  State Running(Interval from, std::optional<Interval> counted,
                std::optional<std::int64_t> run_until) const {
    return {Phase::kRunning, {from.low, end_}, counted, run_until};
  }

  static bool IsAtRest(const State& state) {
    return state.phase == Phase::kCreated || state.phase == Phase::kPaused;
  }

  static bool MayBeRefused(const State& state, const Request& request) {
    const bool is_running = state.phase == Phase::kRunning;
    switch (request.action) {
      case Action::kStart:
        return state.phase != Phase::kCreated;
      case Action::kPause:
      case Action::kResume:
        return !is_running && state.phase != Phase::kPaused;
      case Action::kStep:
        return request.argument < 1 || !IsAtRest(state);
      case Action::kRunUntil:
        // Refused when the clock has passed that instant; a running one may have.
        return request.argument <= state.step.high || !(is_running || IsAtRest(state));
      case Action::kStop:
      case Action::kReset:
        return false;
    }
    return false;
  }

  // What becomes of a state when the request is accepted; nothing when it cannot be.
  std::optional<State> After(State state, const Request& request, const Sight& seen) const {
    const bool is_running = state.phase == Phase::kRunning;
    state.step.low = std::max(state.step.low, seen.step);
    switch (request.action) {
      case Action::kStart:
        if (state.phase != Phase::kCreated) return std::nullopt;
        return Running(state.step, {}, {});
      case Action::kPause:
        if (state.phase == Phase::kPaused) return state;
        if (!is_running) return std::nullopt;
        return Frozen(Phase::kPaused, state.step);
      case Action::kResume:
        if (state.phase == Phase::kPaused) return Running(state.step, {}, {});
        if (!is_running) return std::nullopt;
        state.counted.reset();
        return state;
      case Action::kStep:
        if (request.argument < 1 || !IsAtRest(state)) return std::nullopt;
        return Running(state.step,
                       Interval{state.step.low - kUnderWay + request.argument,
                                state.step.high + request.argument},
                       {});
      case Action::kRunUntil:
        if (request.argument <= state.step.low - kUnderWay) return std::nullopt;
        if (IsAtRest(state)) return Running(state.step, {}, request.argument);
        if (!is_running) return std::nullopt;
        state.run_until = request.argument;
        return state;
      case Action::kStop:
        if (!IsAtRest(state) && !is_running) return state;
        return Frozen(Phase::kStopped, state.step);
      case Action::kReset:
        return State();
    }
    return std::nullopt;
  }

  // A step whose snapshot can be seen may still be under way for the clock, and then counts.
  static constexpr std::int64_t kUnderWay = 1;

  const std::int64_t end_;
  std::vector<State> states_{State()};
};

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
  scene.duration = dice.Below(2) == 0 ? 0 : 1 + dice.Below(120);
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
  // A few lie in the past.
  if (action == Action::kRunUntil && dice.Below(4) == 0) return {action, 0};
  if (action == Action::kRunUntil) return {action, step + 1 + dice.Below(40)};
  return {action, 0};
}

constexpr auto kRest = {Phase::kCreated, Phase::kPaused, Phase::kStopped, Phase::kFinished,
                        Phase::kFailed};

// What a fresh simulation comes to after `steps`, which must not pass its end.
std::string HashAfter(Simulation& simulation, std::int64_t steps) {
  EXPECT_TRUE(simulation.RunUntil(steps * kStepSize));
  EXPECT_EQ(simulation.WaitForPhase({Phase::kPaused}, kPatience), Phase::kPaused);
  return simulation.state_hash();
}

std::string PlayOneSequence(std::uint32_t seed) {
  Dice dice(seed);
  const Scene scene = RandomScene(dice);
  auto simulation = Make(scene);
  LifeCycle model(scene.duration);
  std::string story;
  for (int i = 0; i < 14; ++i) {
    const Sight before = Look(*simulation);
    const Request request = RandomRequest(dice, before.step);
    const base::Status answer = Perform(*simulation, request);
    story += std::string(" ") + NameOf(request.action) + "(" + std::to_string(request.argument) +
             ")" + (answer ? "" : "!");
    if (!model.Requested(request, before, answer.has_value())) {
      return story + ": the answer to the last request fits no state: " +
             (answer ? "accepted" : answer.error().Sentence());
    }
    if (dice.Below(2) == 0 && model.Settles()) {
      simulation->WaitForPhase(kRest, kPatience);
      model.HasSettled();
      story += " settle";
    }
    const Sight seen = Look(*simulation);
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

// People, programs and the viewer ask at once: nothing hangs, and the simulation is as good as new.
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
