#include "gsv/simulation/pace/pacer.h"

#include <utility>

#include "gsv/simulation/pace/totals.h"

namespace gsv::simulation {
namespace {

WallDuration PeriodOf(base::SimTime step, double factor) {
  return std::chrono::duration_cast<WallDuration>(
      std::chrono::duration<double, std::nano>(static_cast<double>(step.count()) / factor));
}

}  // namespace

Pacer::Pacer(base::SimTime step, double factor) : step_(step), period_(PeriodOf(step, factor)) {}

void Pacer::SetRealTimeFactor(double factor) {
  const WallDuration before = std::exchange(period_, PeriodOf(step_, factor));
  due_ += period_ - before;
}

void Pacer::Restart(WallTime now) { due_ = now; }

bool Pacer::StepStarts(WallTime now) {
  const bool late = now - due_ > period_;
  if (late) {
    ++late_steps_;
    ++ProcessTotals().late_steps;
    due_ = now;
  }
  due_ += period_;
  return late;
}

}  // namespace gsv::simulation
