// The life cycle of a run: its phase, its end, and the result.
//
// RunControl decides. Its owner carries out the Change that a call returns: it starts behaviours,
// emits events and wakes threads.
//
// Errors   a request that the phase does not allow fails with kNotRunning and changes nothing.
// Threads  one call at a time; it has no thread, lock or clock.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <optional>
#include <string>

#include "gsv/base/error.h"
#include "gsv/simulation/types.h"

namespace gsv::simulation {

// Returns the number of steps of length `step` from `now` to the first instant at or after `end`.
// `end` must not be before `now`.
inline std::int64_t StepsUntil(SimTime now, SimTime end, SimTime step) {
  return (end - now + step - SimTime(1)) / step;
}

// The state machine of a run: its phase, and the requests that each phase allows.
class RunControl {
 public:
  // How a call changes the phase.
  enum class Change {
    kNone,
    kStarted,   // created → starting
    kResumed,   // paused → starting
    kRunning,   // starting → running
    kPaused,    // starting or running → paused
    kStopped,   // any → stopped
    kFinished,  // running or paused → finished
    kFailed,    // any → failed
  };

  // Errors name `simulation`. If `duration` is 0, the run ends only when it is stopped.
  RunControl(std::string simulation, SimTime duration)
      : simulation_(std::move(simulation)), duration_(duration) {}

  Phase phase() const { return phase_; }
  bool is_running() const { return phase_ == Phase::kRunning; }
  // Whether the phase is stopped, finished or failed.
  bool has_ended() const;
  // Fails with kNotRunning unless the phase is among `allowed`. `action` completes the words "to …"
  // in the error message.
  base::Status Require(std::initializer_list<Phase> allowed, const char* action) const;

  // The requests, as in the class Simulation.
  base::Result<Change> Start();
  base::Result<Change> Pause();
  base::Result<Change> Resume();
  base::Result<Change> Step(std::int64_t count);
  base::Result<Change> RunUntil(SimTime until, SimTime now);
  base::Result<Change> RunThrough(SimTime until, SimTime now);
  Change Stop();
  // A reset has two parts. First BeginReset() stops the run, and the owner waits for behaviours and
  // resets everything. Then FinishReset() returns to the phase "created". kNone means that there is
  // nothing to reset.
  Change BeginReset();
  // Returns to the phase "created" after a reset.
  void FinishReset();

  // Each pending start of a behaviour keeps the run in the phase "starting".
  void BeginStart() { ++starts_pending_; }
  // Ends a pending start of a behaviour.
  void EndStart() { --starts_pending_; }
  // Returns kRunning if the run was starting and no start is pending.
  Change RunIfStarted();

  // Called by the stepping thread when it wakes the agents that wait for this instant.
  void BeginTurns() { turns_have_begun_ = true; }
  // Call this when all turns at `now` are over. Returns kPaused if RunThrough() ends at `now`.
  Change EndTurns(SimTime now);
  // Call this when a step begins.
  void BeginStep() { run_of_step_ = run_; }
  // Returns the number of steps of length `step` that may be taken at once at `now`, at most
  // `limit`: the run neither ends nor pauses before the last of them ends.
  int StepsAtOnce(SimTime now, SimTime step, int limit) const;
  // Call this when the step that ended at `now` is complete, or several steps that were taken at
  // once.
  Change EndStep(SimTime now, int steps = 1);

  // Ends the run in the phase "failed".
  Change Fail(std::string reason);
  // Why the run failed.
  const std::string& failure() const { return failure_; }

  // The hash of the state at which the run finished; empty in all other phases.
  const std::string& final_hash() const { return final_hash_; }
  void SetFinalHash(std::string hash) { final_hash_ = std::move(hash); }

  // How many times the run has started or resumed.
  std::uint64_t run() const { return run_; }
  // Returns whether an edit that is made now comes before, during or after the turns at this
  // instant. `all_wait` is true if no agent is in its turn.
  Edit::Moment MomentOfEdit(bool all_wait) const;
  // Edits of bodies before the first start are part of the setup and do not count as edits of the
  // run.
  void MarkEdited() { was_edited_ = was_edited_ || run_ > 0; }
  // Records an edit that always counts, also before the first start.
  void MarkWorldChanged() { was_edited_ = true; }
  bool was_edited() const { return was_edited_; }

 private:
  // Starts or resumes the run until `until` (0: no limit) or for a number of steps (-1: no limit).
  Change Run(SimTime until, std::int64_t steps);
  // Enters a phase, and returns `change`.
  Change Enter(Phase phase, Change change);

  const std::string simulation_;
  const SimTime duration_;  // simulated time at which the run ends; 0: no limit

  Phase phase_ = Phase::kCreated;
  int starts_pending_ = 0;  // number of behaviours whose start has not ended
  // The instants at which the run pauses by itself. A start or a resume sets them.
  std::optional<SimTime> run_until_;    // pauses after the step that reaches this time
  std::optional<SimTime> run_through_;  // pauses after the turns at this instant
  std::int64_t steps_left_ = -1;        // pauses after this number of steps; -1: no limit

  std::uint64_t run_ = 0;          // number of starts and resumes so far
  std::uint64_t run_of_step_ = 0;  // value of `run_` when the current step began
  bool turns_have_begun_ = false;  // whether the agents that wait for this instant were woken
  bool was_edited_ = false;
  std::string failure_;  // why the run failed; empty if it has not
  std::string final_hash_;
};

}  // namespace gsv::simulation
