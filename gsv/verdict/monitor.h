// Evaluates one formula (scenario/expectation.h) on a run, step by step and as early as possible.
// At each step, the monitor rewrites the remaining obligation (formula progression: F. Bacchus and
// F. Kabanza, "Planning for temporally extended goals", 1998).
//
// Units        simulated time.
// Determinism  the verdict is a function of the truth values and the times of the steps.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "gsv/base/sim_time.h"
#include "gsv/scenario/expectation.h"

namespace gsv::verdict {

// The part of a formula that the rest of the run must still satisfy.
class Obligation;
using ObligationPtr = std::shared_ptr<const Obligation>;

class Monitor {
 public:
  // `number(atom)` gives each atom of the formula a number. Step() uses this number.
  Monitor(const scenario::Formula& formula,
          const std::function<int(const scenario::Formula& atom)>& number);

  // Evaluates the state at `now`. The next state follows after `step`. Does nothing if the verdict
  // is already known.
  void Step(base::SimTime now, base::SimTime step, const std::function<bool(int atom)>& holds);
  // Ends the run. Pending "eventually" obligations become violated; pending "always" obligations
  // become satisfied.
  void End();

  // The verdict; nullopt while it is undecided.
  std::optional<bool> verdict() const;

 private:
  ObligationPtr rest_;  // the obligation after the last evaluated step
};

}  // namespace gsv::verdict
