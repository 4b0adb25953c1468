// Judges one formula (scenario/expectation.h) on a run, step by step, as soon as it can be: what
// remains to be shown is rewritten at each step (formula progression: F. Bacchus and F. Kabanza,
// "Planning for temporally extended goals", 1998).
//
// Units        simulated time.
// Determinism  a function of the truth values and the steps' times.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "gsv/base/sim_time.h"
#include "gsv/scenario/expectation.h"

namespace gsv::verdict {

class Obligation;
using ObligationPtr = std::shared_ptr<const Obligation>;

class Monitor {
 public:
  // The atoms of the formula get the numbers `number(atom)`, by which Step() asks for their truth.
  Monitor(const scenario::Formula& formula,
          const std::function<int(const scenario::Formula& atom)>& number);

  // The next state: at `now`, and the one after it comes `step` later. Nothing more is done once
  // the verdict is known.
  void Step(base::SimTime now, base::SimTime step, const std::function<bool(int atom)>& holds);
  // There is no further state: what had to come and has not is violated, what had to last has.
  void End();

  // Nothing as long as it may go either way.
  std::optional<bool> verdict() const;

 private:
  ObligationPtr rest_;
};

}  // namespace gsv::verdict
