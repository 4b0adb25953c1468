// Evaluates a scenario's expectations at every state that the stepping thread publishes. The
// verdicts depend on these states only.
//
// Threads  Attach() before the run; OnSnapshot() on the stepping thread; Finish() once, after the
//          run.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "gsv/base/mutex.h"
#include "gsv/scenario/scenario.h"
#include "gsv/simulation/simulation.h"
#include "gsv/verdict/margin.h"
#include "gsv/verdict/measure.h"
#include "gsv/verdict/monitor.h"

namespace gsv::verdict {

// The values of one condition of an expectation during the run.
struct MeasuredAtom {
  scenario::Formula atom;
  bool was_measured = false;  // false if the quantity was never available
  // range of the values up to the verdict, and the value at the verdict (`last`)
  double lowest = 0, highest = 0, last = 0;
  double lowest_at = 0, highest_at = 0;  // times of the lowest and the highest value, s
  // for Quantity::Kind::kStuck: the robot that is stuck longest, used if the quantity names no
  // robot
  std::string about;
};

// The verdict on one expectation, and its reasons.
struct Finding {
  std::string name, yaml, where;  // copied from the expectation
  bool holds = false;             // the verdict
  // The first step at which the verdict was certain.
  std::int64_t step = 0;
  base::SimTime time{0};
  std::vector<MeasuredAtom> atoms;  // the conditions of the expectation

  // Returns a sentence such as "violated at 3.21 s (step 321): the distance between a and b was
  // 0.39 m, …".
  std::string Sentence() const;
};

// The observer that evaluates the expectations.
class Judge final : public simulation::Observer, public simulation::ExpectationSource {
 public:
  // Observes the simulation until the judge is destroyed. The simulation must have its robots and
  // must not have started. Fails if Measure::Check() fails for an expectation; the error names
  // the place of the expectation. A verdict before the end of the run is emitted as an event,
  // "expectation_violated" or "expectation_held". At the end of the run, only violations are
  // emitted.
  static base::Result<std::shared_ptr<Judge>> Attach(
      const std::vector<scenario::Expectation>& expectations, simulation::Simulation& simulation);

  void OnSnapshot(const std::shared_ptr<const world::Snapshot>& snapshot) override;
  void OnEvent(const simulation::Event&) override {}

  std::vector<simulation::ExpectationState> states() const override;

  // Returns the findings in the order of the expectations. Waits until the last state was
  // evaluated.
  std::vector<Finding> Finish();
  // The state at which the first violation became certain; null if there was none.
  std::shared_ptr<const world::Snapshot> first_violation() const;

 private:
  // An expectation with its evaluation so far. Its finding is final when the monitor has a verdict.
  struct Pending {
    Finding finding;  // the verdict so far
    Monitor monitor;
    scenario::Formula formula;
    std::optional<Margin> margin;  // nullopt if the expectation has no margin
  };
  explicit Judge(simulation::Simulation& simulation)
      : simulation_(simulation), measure_(simulation) {}
  // Evaluates the undecided expectations at a state.
  void JudgeState(const std::shared_ptr<const world::Snapshot>& snapshot);
  // Completes the finding, and emits its event. `is_end`: the verdict follows from the end of the
  // run.
  void RecordVerdict(Pending& pending, const std::shared_ptr<const world::Snapshot>& snapshot,
                     bool is_end = false) GSV_REQUIRES(mutex_);
  // Emits the event of a verdict.
  void EmitVerdict(const Finding& finding);

  simulation::Simulation& simulation_;
  Measure measure_;
  mutable base::Mutex mutex_;
  base::ConditionVariable judged_;  // notified when a state was evaluated
  // All expectations, in the order of the scenario.
  std::vector<Pending> pending_ GSV_GUARDED_BY(mutex_);
  // The last evaluated state.
  std::shared_ptr<const world::Snapshot> latest_ GSV_GUARDED_BY(mutex_);
  std::shared_ptr<const world::Snapshot> first_violation_ GSV_GUARDED_BY(mutex_);
};

}  // namespace gsv::verdict
