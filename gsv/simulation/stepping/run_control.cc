#include "gsv/simulation/stepping/run_control.h"

#include <algorithm>
#include <utility>

namespace gsv::simulation {

bool RunControl::has_ended() const {
  return phase_ == Phase::kStopped || phase_ == Phase::kFinished || phase_ == Phase::kFailed;
}

base::Status RunControl::Require(std::initializer_list<Phase> allowed, const char* action) const {
  if (std::find(allowed.begin(), allowed.end(), phase_) != allowed.end()) return {};
  std::string phases;
  for (const Phase phase : allowed)
    phases += (phases.empty() ? "" : " or ") + std::string(ToString(phase));
  return base::Fail(
      base::ErrorCode::kNotRunning,
      std::string("to ") + action + " it must be " + phases + ", and it is " + ToString(phase_),
      simulation_);
}

RunControl::Change RunControl::Enter(Phase phase, Change change) {
  phase_ = phase;
  return change;
}

RunControl::Change RunControl::Run(SimTime until, std::int64_t steps) {
  run_until_ = until > SimTime(0) ? std::optional(until) : std::nullopt;
  run_through_.reset();
  steps_left_ = steps;
  ++run_;
  if (phase_ == Phase::kPaused) return Enter(Phase::kStarting, Change::kResumed);
  turns_have_begun_ = true;  // every behaviour has a turn at the start
  return Enter(Phase::kStarting, Change::kStarted);
}

base::Result<RunControl::Change> RunControl::Start() {
  if (auto ok = Require({Phase::kCreated}, "start"); !ok) return base::Fail(ok.error());
  return Run(SimTime(0), -1);
}

base::Result<RunControl::Change> RunControl::Pause() {
  if (phase_ == Phase::kPaused) return Change::kNone;
  if (auto ok = Require({Phase::kStarting, Phase::kRunning}, "pause"); !ok)
    return base::Fail(ok.error());
  return Enter(Phase::kPaused, Change::kPaused);
}

base::Result<RunControl::Change> RunControl::Resume() {
  if (phase_ == Phase::kRunning || phase_ == Phase::kStarting) {
    steps_left_ = -1;  // the run continues after the requested steps
    return Change::kNone;
  }
  if (auto ok = Require({Phase::kPaused}, "resume"); !ok) return base::Fail(ok.error());
  return Run(SimTime(0), -1);
}

base::Result<RunControl::Change> RunControl::Step(std::int64_t count) {
  if (count < 1 || count > 1'000'000'000) {
    return base::Fail(base::ErrorCode::kInvalidArgument,
                      "the number of steps is " + std::to_string(count) +
                          "; it must lie between 1 and 1000000000",
                      simulation_);
  }
  if (auto ok = Require({Phase::kCreated, Phase::kPaused}, "step"); !ok)
    return base::Fail(ok.error());
  return Run(SimTime(0), count);
}

base::Result<RunControl::Change> RunControl::RunUntil(SimTime until, SimTime now) {
  if (auto ok =
          Require({Phase::kCreated, Phase::kPaused, Phase::kStarting, Phase::kRunning}, "run");
      !ok) {
    return base::Fail(ok.error());
  }
  if (until <= now) {
    return base::Fail(base::ErrorCode::kInvalidArgument,
                      "cannot run until a time that is " +
                          std::to_string(base::ToSeconds(now - until)) + " s in the past",
                      simulation_);
  }
  if (phase_ == Phase::kCreated || phase_ == Phase::kPaused) return Run(until, -1);
  run_until_ = until;
  return Change::kNone;
}

base::Result<RunControl::Change> RunControl::RunThrough(SimTime until, SimTime now) {
  if (auto ok = Require({Phase::kCreated, Phase::kPaused}, "run"); !ok)
    return base::Fail(ok.error());
  if (until < now) {
    return base::Fail(base::ErrorCode::kInvalidArgument,
                      "cannot run through a time that is " +
                          std::to_string(base::ToSeconds(now - until)) + " s in the past",
                      simulation_);
  }
  const Change change = Run(SimTime(0), -1);
  run_through_ = until;
  return change;
}

RunControl::Change RunControl::Stop() {
  return has_ended() ? Change::kNone : Enter(Phase::kStopped, Change::kStopped);
}

RunControl::Change RunControl::BeginReset() {
  return phase_ == Phase::kCreated ? Change::kNone : Enter(Phase::kStopped, Change::kStopped);
}

void RunControl::FinishReset() {
  phase_ = Phase::kCreated;
  turns_have_begun_ = false;
  failure_.clear();
  final_hash_.clear();
}

RunControl::Change RunControl::RunIfStarted() {
  if (phase_ != Phase::kStarting || starts_pending_ > 0) return Change::kNone;
  return Enter(Phase::kRunning, Change::kRunning);
}

RunControl::Change RunControl::EndTurns(SimTime now) {
  if (!is_running() || !run_through_ || now < *run_through_) return Change::kNone;
  run_through_.reset();
  return Enter(Phase::kPaused, Change::kPaused);
}

int RunControl::StepsAtOnce(SimTime now, SimTime step, int limit) const {
  SimTime end = now + limit * step;
  if (duration_ > SimTime(0)) end = std::min(end, duration_);
  if (run_until_) end = std::min(end, *run_until_);
  if (run_through_) end = std::min(end, *run_through_);
  std::int64_t steps = StepsUntil(now, end, step);
  if (steps_left_ > 0) steps = std::min(steps, steps_left_);
  return static_cast<int>(std::max<std::int64_t>(steps, 1));
}

RunControl::Change RunControl::EndStep(SimTime now, int steps) {
  turns_have_begun_ = false;
  // If a pause was requested during a step, that step does not count among the steps that are
  // requested after the pause.
  if (steps_left_ > 0 && run_of_step_ == run_) {
    steps_left_ -= std::min<std::int64_t>(steps, steps_left_);
  }
  // A run that was paused during its last step also finishes here. If it did not finish here, it
  // would take one step too many after a resume.
  if (duration_ > SimTime(0) && now >= duration_) {
    const bool ends = phase_ != Phase::kStopped && phase_ != Phase::kFailed;
    return ends ? Enter(Phase::kFinished, Change::kFinished) : Change::kNone;
  }
  if (steps_left_ != 0 && !(run_until_ && now >= *run_until_)) return Change::kNone;
  run_until_.reset();
  steps_left_ = -1;
  const bool runs = phase_ == Phase::kRunning || phase_ == Phase::kStarting;
  return runs ? Enter(Phase::kPaused, Change::kPaused) : Change::kNone;
}

RunControl::Change RunControl::Fail(std::string reason) {
  failure_ = std::move(reason);
  return Enter(Phase::kFailed, Change::kFailed);
}

Edit::Moment RunControl::MomentOfEdit(bool all_wait) const {
  const bool is_at_rest = phase_ == Phase::kCreated || phase_ == Phase::kPaused;
  if (is_at_rest && !turns_have_begun_) return Edit::Moment::kBeforeTurns;
  if (is_at_rest && all_wait) return Edit::Moment::kAfterTurns;
  return Edit::Moment::kAmidTurns;
}

}  // namespace gsv::simulation
