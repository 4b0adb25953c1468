// A ReplayClock is the position of a replay in simulated time. It advances with the wall clock
// while the replay plays. It has the same phases as a simulation, so viewers show replays and
// simulations alike.
//
// Threads  one thread at a time.
#pragma once

#include <chrono>

#include "gsv/base/error.h"
#include "gsv/base/sim_time.h"
#include "gsv/simulation/types.h"

namespace gsv::gateway {

// The position and the phase of a replay.
class ReplayClock {
 public:
  using WallTime = std::chrono::steady_clock::time_point;

  // Begins at `start`. `speed` is in simulated seconds per second of wall-clock time, > 0.
  ReplayClock(base::SimTime start, base::SimTime end, double speed, bool loop)
      : start_(start), end_(end), speed_(speed), loop_(loop), position_(start) {}

  base::SimTime start() const { return start_; }
  base::SimTime end() const { return end_; }
  base::SimTime position() const { return position_; }
  double speed() const { return speed_; }
  bool loop() const { return loop_; }
  simulation::Phase phase() const { return phase_; }
  bool is_playing() const { return phase_ == simulation::Phase::kRunning; }

  // These functions fail with kNotRunning and a sentence if the current phase does not allow them.
  base::Status Start();
  base::Status Pause();
  base::Status Resume();
  // Advances by `time` and pauses. At the end, the phase is kFinished.
  base::Status Step(base::SimTime time);
  void Rewind();  // Returns to the start, in the phase kCreated.
  // Moves within the recording, and continues playing if it played.
  void Seek(base::SimTime time);
  // Moves within the recording and pauses.
  void SeekAndPause(base::SimTime time);
  // Sets the speed, > 0.
  void SetSpeed(double speed) { speed_ = speed; }
  void SetLoop(bool loop) { loop_ = loop; }

  // Advances with the wall clock while the replay plays. Returns true if the replay has reached its
  // end and restarted, because of SetLoop(true). Without a loop, it stays at the end in the phase
  // kFinished.
  bool Advance(WallTime now);

 private:
  const base::SimTime start_;  // the first time of the recording
  const base::SimTime end_;    // the last time of the recording
  double speed_;               // simulated seconds per second of wall-clock time, > 0
  bool loop_;                  // whether the replay restarts at its end
  base::SimTime position_;     // the present time of the replay
  simulation::Phase phase_ = simulation::Phase::kCreated;
  WallTime last_{};  // time of the last Advance(); {} before the first call
};

}  // namespace gsv::gateway
