// Which fault happens next. A fault happens between two steps, at the first instant at or after its
// time, before anybody is woken or reads there: its place in a run depends on nothing else.
#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include "gsv/base/sim_time.h"
#include "gsv/scenario/fault.h"

namespace gsv::simulation {

class FaultSchedule {
 public:
  // Faults happen in the order of their times; those of one time in the order given.
  explicit FaultSchedule(std::vector<scenario::Fault> faults) : faults_(std::move(faults)) {
    std::stable_sort(faults_.begin(), faults_.end(),
                     [](const auto& a, const auto& b) { return a.at < b.at; });
  }

  const std::vector<scenario::Fault>& all() const { return faults_; }
  // The number of faults that have happened.
  std::size_t done() const { return done_; }
  bool IsDue(base::SimTime now) const {
    return done_ < faults_.size() && base::FromSeconds(faults_[done_].at) <= now;
  }
  // The next fault, which IsDue(): it happens now.
  const scenario::Fault& TakeDue() { return faults_[done_++]; }
  // No fault has happened yet.
  void Rewind() { done_ = 0; }

 private:
  std::vector<scenario::Fault> faults_;
  std::size_t done_ = 0;
};

}  // namespace gsv::simulation
