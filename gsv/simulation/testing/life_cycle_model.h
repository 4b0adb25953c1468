// For tests: a model of the requests start, pause, resume, step, run until, stop and reset. The run
// advances by itself, so the model keeps every state that the simulation may be in. Each answer and
// observation must be possible in one of these states.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "gsv/simulation/types.h"

namespace gsv::simulation::life_cycle {

enum class Action { kStart, kPause, kResume, kStep, kRunUntil, kStop, kReset };

// A request to a simulation.
struct Request {
  Action action;
  // number of steps for kStep, or target step for kRunUntil
  std::int64_t argument = 0;
};

// An observation by a test. The phase kStarting counts as running.
struct Observed {
  Phase phase;
  std::int64_t step;
};

inline constexpr std::int64_t kUnbounded = std::numeric_limits<std::int64_t>::max();

// A range of steps.
struct Interval {
  std::int64_t low = 0, high = 0;
};

// A possible state of the simulation.
struct State {
  Phase phase = Phase::kCreated;
  Interval step;  // range of steps that the latest snapshot may have
  // only while running: the step at which the requested number of steps is complete
  std::optional<Interval> counted;
  std::optional<std::int64_t> run_until;  // only while running: the step of a request kRunUntil

  // Returns the step at which the run pauses by itself.
  std::optional<Interval> Goal() const {
    if (!run_until) return counted;
    if (!counted) return Interval{*run_until, *run_until};
    return Interval{std::min(counted->low, *run_until), std::min(counted->high, *run_until)};
  }
};

// Returns a state in which the run does not advance.
inline State Frozen(Phase phase, Interval step) {
  return {.phase = phase, .step = step, .counted = {}, .run_until = {}};
}

// All states that the simulation may be in after the requests and observations so far.
class LifeCycleModel {
 public:
  explicit LifeCycleModel(std::int64_t duration) : end_(duration > 0 ? duration : kUnbounded) {}

  // Applies a request. `seen` was observed just before it, and `ok` was its answer. Returns false
  // if this is impossible in every state.
  bool Requested(const Request& request, const Observed& seen, bool ok) {
    std::vector<State> next;
    for (const State& state : WithSpontaneousChanges()) {
      if (ok) {
        if (const auto after = After(state, request, seen)) next.push_back(*after);
      } else if (MayBeRefused(state, request)) {
        next.push_back(state);
      }
    }
    states_ = std::move(next);
    return !states_.empty();
  }

  // Removes the states that contradict an observation. Returns false if none is left.
  bool Seen(const Observed& seen) {
    std::vector<State> next;
    for (State state : WithSpontaneousChanges()) {
      if (state.phase != seen.phase || seen.step < state.step.low || seen.step > state.step.high)
        continue;
      if (state.phase == Phase::kPaused && seen.step >= end_) continue;
      state.step.low = seen.step;
      // If a pause or stop is requested during a step, this step is still completed. No step
      // follows it.
      if (state.phase != Phase::kRunning)
        state.step.high = std::min(state.step.high, seen.step + 1);
      next.push_back(state);
    }
    states_ = std::move(next);
    return !states_.empty();
  }

  // Whether the run pauses or ends by itself, in every possible state.
  bool WillPause() const {
    return std::all_of(states_.begin(), states_.end(), [this](const State& state) {
      return state.phase != Phase::kRunning || state.Goal() || end_ != kUnbounded;
    });
  }
  // Removes the states in which the simulation runs.
  void RequirePaused() {
    std::vector<State> settled;
    for (const State& state : WithSpontaneousChanges()) {
      if (state.phase != Phase::kRunning) settled.push_back(state);
    }
    states_ = std::move(settled);
  }

 private:
  // Returns states_, and the states into which a run changes by itself.
  std::vector<State> WithSpontaneousChanges() const {
    std::vector<State> all = states_;
    for (const State& state : states_) {
      // If a pause was requested during the last step of the run, the run may also have finished.
      if (state.phase == Phase::kPaused && state.step.high >= end_)
        all.push_back(Frozen(Phase::kFinished, {end_, end_}));
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
        // The request is refused if its instant is past. While the simulation runs, either answer
        // is possible.
        return request.argument <= state.step.high || !(is_running || IsAtRest(state));
      case Action::kStop:
      case Action::kReset:
        return false;
    }
    return false;
  }

  // Returns the state after an accepted request, or nullopt if it cannot be accepted.
  std::optional<State> After(State state, const Request& request, const Observed& seen) const {
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
        return Running(
            state.step,
            Interval{state.step.low + request.argument, state.step.high + request.argument}, {});
      case Action::kRunUntil:
        if (request.argument <= state.step.low) return std::nullopt;
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

  const std::int64_t end_;  // step at which the run finishes; kUnbounded if it does not
  std::vector<State> states_{State()};
};

}  // namespace gsv::simulation::life_cycle
