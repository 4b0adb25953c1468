// The margin of an expectation: the difference between the measured number and its limit. This is
// the robustness of signal temporal logic (A. Donzé and O. Maler, 2010). Here, only an expectation
// that is one condition over time has a margin.
//
// Units  the unit of the measured number.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "gsv/scenario/expectation.h"
#include "gsv/simulation/types.h"

namespace gsv::verdict {

class Margin {
 public:
  // `values` are the values of the formula's atoms at `now`, in the order in which Monitor numbers
  // them.
  void Note(base::SimTime now, const std::vector<std::optional<double>>& values);
  // Writes the margin, the unit of the margin, and its instant into `state`.
  void Fill(simulation::ExpectationState& state) const;

 private:
  friend std::optional<Margin> MarginOf(const scenario::Formula& formula);

  scenario::Formula condition_;  // the condition whose margin is computed
  // True for "eventually". The margin is then the largest distance. Otherwise, it is the smallest
  // distance.
  bool must_come_ = false;
  // Start and end of the window in which the margin is computed; no `by_`: to the end of the run.
  base::SimTime from_{0};
  std::optional<base::SimTime> by_;
  std::string unit_;              // unit of the margin; may be empty
  std::optional<double> margin_;  // nullopt before the first value
  base::SimTime at_{0};           // time of margin_
};

// Returns the margin of a formula. Returns nullopt for a formula that is not one condition over
// time, and for a condition without a number, such as a contact.
std::optional<Margin> MarginOf(const scenario::Formula& formula);

// Adds the regions of a formula to `state`. These are the circles and boxes in which bodies must be
// or must not be.
void AddShapes(const scenario::Formula& formula, simulation::ExpectationState& state);

}  // namespace gsv::verdict
