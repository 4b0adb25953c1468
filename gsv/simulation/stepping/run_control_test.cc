// Compares RunControl with the model of the life cycle. The test tries every sequence of requests
// and steps up to a certain length, without threads.
#include "gsv/simulation/stepping/run_control.h"

#include <cmath>

#include <gmock/gmock.h>

#include "gsv/simulation/testing/life_cycle_model.h"

namespace gsv::simulation {
namespace {

using life_cycle::Action;
using life_cycle::LifeCycleModel;
using life_cycle::Observed;
using life_cycle::Request;
using Change = RunControl::Change;

// A run without a world, in which a step is one nanosecond. This class calls RunControl like
// LifeCycle and StepLoop, but on one thread.
class BareRun {
 public:
  // `starts` is the number of behaviours that start with the run. The test decides when these
  // behaviours answer.
  BareRun(std::int64_t duration, int starts) : run_("run", SimTime(duration)), starts_(starts) {}

  RunControl& control() { return run_; }
  std::int64_t step() const { return step_; }
  SimTime now() const { return SimTime(step_); }
  bool is_in_step() const { return is_in_step_; }
  bool has_pending_start() const { return pending_ > 0; }
  Observed Observe() const {
    const bool is_starting = run_.phase() == Phase::kStarting;
    return {is_starting ? Phase::kRunning : run_.phase(), step_};
  }

  bool Perform(const Request& request) {
    if (request.action == Action::kReset) return Reset();
    const auto change = Ask(request);
    if (change) Follow(*change);
    return change.has_value();
  }
  void AnswerStart() {
    --pending_;
    run_.EndStart();
    run_.RunIfStarted();
  }
  void BeginStep() {
    run_.BeginTurns();
    if (run_.EndTurns(now()) != Change::kNone) return;
    run_.BeginStep();
    is_in_step_ = true;
  }
  Change EndStep() {
    is_in_step_ = false;
    ++step_;
    return run_.EndStep(now());
  }
  // Takes steps until the run pauses or ends. Returns false if this takes more than 100 steps.
  bool ApplyTurn() {
    while (has_pending_start()) AnswerStart();
    if (is_in_step_) EndStep();
    for (int i = 0; i < 100 && run_.is_running(); ++i) {
      BeginStep();
      if (is_in_step_) EndStep();
    }
    return !run_.is_running();
  }

 private:
  base::Result<Change> Ask(const Request& request) {
    switch (request.action) {
      case Action::kStart:
        return run_.Start();
      case Action::kPause:
        return run_.Pause();
      case Action::kResume:
        return run_.Resume();
      case Action::kStep:
        return run_.Step(request.argument);
      case Action::kRunUntil:
        return run_.RunUntil(SimTime(request.argument), now());
      case Action::kStop:
      case Action::kReset:
        break;
    }
    return run_.Stop();
  }
  void Follow(Change change) {
    if (change == Change::kStarted) {
      for (int i = 0; i < starts_; ++i) run_.BeginStart();
      pending_ = starts_;
    }
    run_.RunIfStarted();
  }
  bool Reset() {
    if (run_.BeginReset() == Change::kNone) return true;
    while (has_pending_start()) AnswerStart();
    if (is_in_step_) EndStep();
    step_ = 0;
    run_.FinishReset();
    return true;
  }

  RunControl run_;
  const int starts_;
  int pending_ = 0;
  std::int64_t step_ = 0;
  bool is_in_step_ = false;
};

constexpr Request kRequests[] = {
    {Action::kStart},       {Action::kPause},   {Action::kResume}, {Action::kStep, 0},
    {Action::kStep, 1},     {Action::kStep, 2}, {Action::kStop},   {Action::kRunUntil, 1},
    {Action::kRunUntil, 3}, {Action::kReset},
};

constexpr const char* kNames[] = {"start", "pause", "resume", "step", "run_until", "stop", "reset"};

// Tries every continuation of a sequence. After each of them, the run must agree with the model.
class Explorer {
 public:
  // Returns the first sequence that disagrees with the model, or an empty text.
  std::string Explore(const BareRun& run, const LifeCycleModel& model, int length) {
    if (std::string problem = CheckRest(run, model); !problem.empty()) return problem;
    if (length == 0) return {};
    for (const Request& request : kRequests) {
      BareRun next = run;
      LifeCycleModel expected = model;
      const Observed before = next.Observe();
      const bool ok = next.Perform(request);
      const std::string name = std::string(kNames[static_cast<int>(request.action)]) + "(" +
                               std::to_string(request.argument) + ")" + (ok ? "" : "!");
      if (!expected.Requested(request, before, ok)) return Problem(name + ": the answer");
      if (auto problem = Continue(name, next, expected, length); !problem.empty()) return problem;
    }
    BareRun next = run;
    if (run.has_pending_start()) {
      next.AnswerStart();
      return Continue("started", next, model, length);
    }
    if (run.is_in_step()) {
      next.EndStep();
      return Continue("end_step", next, model, length);
    }
    if (!next.control().is_running()) return {};
    next.BeginStep();
    return Continue("begin_step", next, model, length);
  }
  int sequences() const { return sequences_; }

 private:
  std::string Continue(const std::string& name, const BareRun& run, LifeCycleModel model,
                       int length) {
    path_.push_back(name);
    const Observed seen = run.Observe();
    if (!model.Seen(seen)) {
      return Problem(std::string("phase ") + ToString(seen.phase) + " at step " +
                     std::to_string(seen.step));
    }
    std::string problem = Explore(run, model, length - 1);
    path_.pop_back();
    return problem;
  }
  std::string CheckRest(BareRun run, LifeCycleModel model) {
    ++sequences_;
    if (!model.WillPause()) return {};
    if (!run.ApplyTurn()) return Problem("it does not come to rest");
    model.RequirePaused();
    const Observed seen = run.Observe();
    if (model.Seen(seen)) return {};
    return Problem(std::string("it comes to rest ") + ToString(seen.phase) + " at step " +
                   std::to_string(seen.step));
  }
  std::string Problem(const std::string& what) const {
    std::string story;
    for (const std::string& name : path_) story += name + " ";
    return story + "- " + what;
  }

  std::vector<std::string> path_;
  int sequences_ = 0;
};

struct Scope {
  std::int64_t duration;  // number of steps; 0 for a run without end
  int starts;             // the number of behaviours that start with the run
  int length;             // the maximum length of the sequences
};

class EverySequence : public testing::TestWithParam<Scope> {};

TEST_P(EverySequence, FitsTheLifeCycleModel) {
  const Scope scope = GetParam();
  Explorer explorer;
  EXPECT_EQ(explorer.Explore(BareRun(scope.duration, scope.starts), LifeCycleModel(scope.duration),
                             scope.length),
            "");
  EXPECT_GT(explorer.sequences(), std::pow(std::size(kRequests), scope.length));
}

INSTANTIATE_TEST_SUITE_P(RunControl, EverySequence,
                         testing::Values(Scope{0, 0, 4}, Scope{0, 1, 4}, Scope{2, 0, 5},
                                         Scope{2, 1, 4}),
                         [](const auto& scope) {
                           return (scope.param.duration > 0 ? "Bounded" : "Unbounded") +
                                  std::string(scope.param.starts > 0 ? "WithBehaviour" : "");
                         });

void TakeSteps(BareRun& run, int count) {
  for (int i = 0; i < count; ++i) {
    run.BeginStep();
    if (run.is_in_step()) run.EndStep();
  }
}

TEST(RunControl, PausesAfterTheRequestedSteps) {
  BareRun run(0, 0);
  ASSERT_TRUE(run.Perform({Action::kStep, 3}));
  TakeSteps(run, 2);
  EXPECT_TRUE(run.control().is_running());
  TakeSteps(run, 1);
  EXPECT_EQ(run.control().phase(), Phase::kPaused);
}

TEST(RunControl, DoesNotCountAStepThatBeganBeforeThePause) {
  BareRun run(0, 0);
  ASSERT_TRUE(run.Perform({Action::kStart}));
  run.BeginStep();
  ASSERT_TRUE(run.Perform({Action::kPause}));
  ASSERT_TRUE(run.Perform({Action::kStep, 1}));
  EXPECT_EQ(run.EndStep(), Change::kNone);
  EXPECT_TRUE(run.control().is_running());
  TakeSteps(run, 1);
  EXPECT_EQ(run.control().phase(), Phase::kPaused);
  EXPECT_EQ(run.step(), 2);
}

TEST(RunControl, PausesAtItsInstantEvenIfBehavioursAreStillStarting) {
  RunControl run("run", SimTime(0));
  ASSERT_TRUE(run.Start());
  ASSERT_EQ(run.RunIfStarted(), Change::kRunning);
  run.BeginStep();
  ASSERT_TRUE(run.Pause());
  ASSERT_EQ(*run.RunUntil(SimTime(1), SimTime(0)), Change::kResumed);
  run.BeginStart();  // starts the behaviour of a robot that was added during the pause
  EXPECT_EQ(run.EndStep(SimTime(1)), Change::kPaused);
  run.EndStart();
  EXPECT_EQ(run.RunIfStarted(), Change::kNone);
}

TEST(RunControl, RunThroughPausesAfterTheTurnsWithoutAStep) {
  BareRun run(0, 0);
  ASSERT_TRUE(run.control().RunThrough(SimTime(1), SimTime(0)));
  ASSERT_EQ(run.control().RunIfStarted(), Change::kRunning);
  TakeSteps(run, 1);
  EXPECT_TRUE(run.control().is_running());
  run.BeginStep();
  EXPECT_FALSE(run.is_in_step());
  EXPECT_EQ(run.control().phase(), Phase::kPaused);
  EXPECT_FALSE(run.control().RunThrough(SimTime(0), SimTime(1)));
}

TEST(RunControl, StepsAtOnceEndWhereTheRunPausesOrEnds) {
  const auto started = [](SimTime duration) {
    RunControl run("run", duration);
    EXPECT_TRUE(run.Start());
    EXPECT_EQ(run.RunIfStarted(), Change::kRunning);
    run.BeginStep();
    return run;
  };
  RunControl run = started(SimTime(0));
  EXPECT_EQ(run.StepsAtOnce(SimTime(0), SimTime(10), 8), 8);
  ASSERT_TRUE(run.RunUntil(SimTime(31), SimTime(0)));
  EXPECT_EQ(run.StepsAtOnce(SimTime(0), SimTime(10), 8), 4);  // the fourth step ends at 40
  EXPECT_EQ(run.EndStep(SimTime(40), 4), Change::kPaused);
  ASSERT_TRUE(run.RunThrough(SimTime(60), SimTime(40)));
  EXPECT_EQ(run.StepsAtOnce(SimTime(40), SimTime(10), 8), 2);
  EXPECT_EQ(started(SimTime(20)).StepsAtOnce(SimTime(0), SimTime(10), 8), 2);
}

TEST(RunControl, CountsStepsAtOnceAsManySteps) {
  RunControl run("run", SimTime(0));
  ASSERT_TRUE(run.Step(5));
  ASSERT_EQ(run.RunIfStarted(), Change::kRunning);
  run.BeginStep();
  EXPECT_EQ(run.StepsAtOnce(SimTime(0), SimTime(10), 3), 3);
  EXPECT_EQ(run.EndStep(SimTime(30), 3), Change::kNone);
  run.BeginStep();
  EXPECT_EQ(run.StepsAtOnce(SimTime(30), SimTime(10), 3), 2);
  EXPECT_EQ(run.EndStep(SimTime(50), 2), Change::kPaused);
}

TEST(RunControl, RunsWhenTheLastBehaviourHasStarted) {
  BareRun run(0, 2);
  ASSERT_TRUE(run.Perform({Action::kStart}));
  run.AnswerStart();
  EXPECT_EQ(run.control().phase(), Phase::kStarting);
  run.AnswerStart();
  EXPECT_EQ(run.control().phase(), Phase::kRunning);
}

TEST(RunControl, FinishesWhenPausedDuringItsLastStep) {
  BareRun run(1, 0);
  ASSERT_TRUE(run.Perform({Action::kStart}));
  run.BeginStep();
  ASSERT_TRUE(run.Perform({Action::kPause}));
  EXPECT_EQ(run.EndStep(), Change::kFinished);
}

TEST(RunControl, KeepsTheFailureAndTheHashUntilAReset) {
  BareRun run(1, 0);
  ASSERT_TRUE(run.Perform({Action::kStart}));
  TakeSteps(run, 1);
  run.control().SetFinalHash("1234");
  EXPECT_EQ(run.control().Fail("no reason"), Change::kFailed);
  EXPECT_EQ(run.control().failure(), "no reason");
  ASSERT_TRUE(run.Perform({Action::kReset}));
  EXPECT_EQ(run.control().failure(), "");
  EXPECT_EQ(run.control().final_hash(), "");
  EXPECT_EQ(run.control().phase(), Phase::kCreated);
}

TEST(RunControl, NamesTheAllowedPhasesWhenItRefuses) {
  RunControl run("office", SimTime(0));
  const auto resumed = run.Resume();
  ASSERT_FALSE(resumed);
  EXPECT_EQ(resumed.error().code, base::ErrorCode::kNotRunning);
  EXPECT_EQ(resumed.error().Sentence(), "office: to resume it must be paused, and it is created");
}

TEST(RunControl, RecordsTheTurnsThatAnEditPrecedes) {
  BareRun run(0, 0);
  EXPECT_EQ(run.control().MomentOfEdit(true), Edit::Moment::kBeforeTurns);
  ASSERT_TRUE(run.Perform({Action::kStep, 1}));
  EXPECT_EQ(run.control().MomentOfEdit(true), Edit::Moment::kAmidTurns);  // the run is in the phase
                                                                          // "running"
  TakeSteps(run, 1);
  EXPECT_EQ(run.control().MomentOfEdit(true), Edit::Moment::kBeforeTurns);
  ASSERT_TRUE(run.control().RunThrough(run.now(), run.now()));
  ASSERT_EQ(run.control().RunIfStarted(), Change::kRunning);
  run.BeginStep();
  EXPECT_EQ(run.control().MomentOfEdit(true), Edit::Moment::kAfterTurns);
  EXPECT_EQ(run.control().MomentOfEdit(false), Edit::Moment::kAmidTurns);
}

TEST(RunControl, CountsEditsFromTheFirstStartOn) {
  BareRun run(0, 0);
  run.control().MarkEdited();
  EXPECT_FALSE(run.control().was_edited());
  EXPECT_EQ(run.control().run(), 0u);
  ASSERT_TRUE(run.Perform({Action::kStep, 1}));
  TakeSteps(run, 1);
  run.control().MarkEdited();
  EXPECT_TRUE(run.control().was_edited());
  EXPECT_EQ(run.control().run(), 1u);
}

TEST(RunControl, CountsChangesOfTheWorldBeforeTheFirstStart) {
  BareRun run(0, 0);
  run.control().MarkWorldChanged();
  EXPECT_TRUE(run.control().was_edited());
}

}  // namespace
}  // namespace gsv::simulation
