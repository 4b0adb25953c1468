// Receives the snapshots and events of a simulation. See Simulation::AddObserver().
//
// Threads  snapshots come from the stepping thread, which holds no lock then, so const members of
//          the simulation may be called. Events come from any thread with locks held, so no member
//          of the simulation may be called. Both functions must return at once.
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <string>

#include "gsv/simulation/types.h"
#include "gsv/world/snapshot.h"

namespace gsv::simulation {

// The wall-clock time of one step by part, from the end of the step before. A pause does not
// count.
struct StepTimes {
  std::int64_t step = 0;
  SimTime time{0};
  std::chrono::nanoseconds behaviours{0};  // behaviours' turns; in lockstep also waits for them
  std::chrono::nanoseconds devices{0};     // actuators, radios and other devices
  std::chrono::nanoseconds bodies{0};      // motion and contacts
  std::chrono::nanoseconds observers{0};   // recorders and viewers
  std::chrono::nanoseconds idle{0};        // wait until the step was due, in real time
  // The robot whose behaviour the step waited for last; empty: none.
  std::string held_up_by;

  std::chrono::nanoseconds total() const {
    return behaviours + devices + bodies + observers + idle;
  }
};

class Observer {
 public:
  virtual ~Observer() = default;
  // Whether OnTimes() is called. It must not change. Steps are timed while an observer requests it.
  virtual bool wants_times() const { return false; }
  // The times of a step, after OnSnapshot(), on the stepping thread.
  virtual void OnTimes(const StepTimes&) {}
  virtual void OnSnapshot(const std::shared_ptr<const world::Snapshot>& snapshot) = 0;
  virtual void OnEvent(const Event& event) = 0;
};

}  // namespace gsv::simulation
