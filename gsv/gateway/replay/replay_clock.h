// Where a replay stands: a position in simulated time that moves with the wall clock while it
// plays. Phases are those of a simulation, so that a viewer need not know the difference.
//
// Threads  one at a time.
#pragma once

#include <chrono>

#include "gsv/base/error.h"
#include "gsv/base/sim_time.h"
#include "gsv/simulation/types.h"

namespace gsv::gateway {

class ReplayClock {
 public:
  using WallTime = std::chrono::steady_clock::time_point;

  // Stands at `start`. `speed`: simulated seconds a wall second, > 0.
  ReplayClock(base::SimTime start, base::SimTime end, double speed, bool loop)
      : start_(start), end_(end), speed_(speed), loop_(loop), position_(start) {}

  base::SimTime start() const { return start_; }
  base::SimTime end() const { return end_; }
  base::SimTime position() const { return position_; }
  double speed() const { return speed_; }
  bool loop() const { return loop_; }
  simulation::Phase phase() const { return phase_; }
  bool is_playing() const { return phase_ == simulation::Phase::kRunning; }

  // kNotRunning with a sentence when the phase does not allow it.
  base::Status Start();
  base::Status Pause();
  base::Status Resume();
  // Moves on by `time`, then stands still.
  base::Status Step(base::SimTime time);
  void Rewind();  // to the start, where it waits
  // Within the recording; plays on if it played.
  void Seek(base::SimTime time);
  // Within the recording, where it stands still.
  void StandAt(base::SimTime time);
  // > 0, from here on.
  void SetSpeed(double speed) { speed_ = speed; }
  void SetLoop(bool loop) { loop_ = loop; }

  // Moves with the wall clock. True when it went past the end and begins anew (with `loop`);
  // without it stays at the end, finished.
  bool Advance(WallTime now);

 private:
  const base::SimTime start_;
  const base::SimTime end_;
  double speed_;
  bool loop_;
  base::SimTime position_;
  simulation::Phase phase_ = simulation::Phase::kCreated;
  WallTime last_{};  // when it was advanced; {}: it has to begin
};

}  // namespace gsv::gateway
