#include "gsv/simulation/pacer.h"

namespace gsv::simulation {

Pacer::Pacer(base::SimTime step, double factor)
    : period_(std::chrono::duration_cast<WallDuration>(
          std::chrono::duration<double, std::nano>(static_cast<double>(step.count()) / factor))) {}

void Pacer::Restart(WallTime now) { due_ = now; }

bool Pacer::StepStarts(WallTime now) {
  const bool late = now - due_ > period_;
  if (late) {
    ++late_steps_;
    due_ = now;
  }
  due_ += period_;
  return late;
}

}  // namespace gsv::simulation
