// Orders the faults of a run. A fault is applied between two steps, at the first instant at or
// after its time, before any agent wakes or reads a sensor. So its moment is deterministic.
#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include "gsv/base/sim_time.h"
#include "gsv/base/sorting.h"
#include "gsv/scenario/fault.h"

namespace gsv::simulation {

// The faults of a run, in the order of their times.
class FaultSchedule {
 public:
  // Faults are applied in the order of their times. Faults with equal times keep the given order.
  explicit FaultSchedule(std::vector<scenario::Fault> faults) : faults_(std::move(faults)) {
    base::Sort(faults_, [](const auto& a, const auto& b) { return a.at < b.at; });
  }

  const std::vector<scenario::Fault>& all() const { return faults_; }
  // The number of faults that have been applied.
  std::size_t done() const { return done_; }
  // Whether a fault must be applied now.
  bool IsDue(base::SimTime now) const {
    return done_ < faults_.size() && base::FromSeconds(faults_[done_].at) <= now;
  }
  // Returns the instant of the next fault; `limit` if there is none before it.
  base::SimTime Next(base::SimTime limit) const {
    return done_ < faults_.size() ? std::min(limit, base::FromSeconds(faults_[done_].at)) : limit;
  }
  // Returns the next fault, which must be due, and advances to the following one.
  const scenario::Fault& TakeDue() { return faults_[done_++]; }
  // Starts again with the first fault.
  void Rewind() { done_ = 0; }

 private:
  std::vector<scenario::Fault> faults_;
  std::size_t done_ = 0;  // number of applied faults; also the index of the next fault
};

}  // namespace gsv::simulation
