// The interface of objects that receive the snapshots and events of a simulation. See
// Simulation::AddObserver().
//
// Threads  the stepping thread passes snapshots and holds no lock meanwhile, so const members of
//          the simulation may be called. Any thread may pass events and holds locks meanwhile, so
//          no member of the simulation may be called. All functions must return at once.
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <string>

#include "gsv/simulation/types.h"
#include "gsv/world/snapshot.h"

namespace gsv::simulation {

// The wall-clock times of the parts of one step, measured from the end of the previous step. Pauses
// do not count.
struct StepTimes {
  std::int64_t step = 0;
  SimTime time{0};
  std::chrono::nanoseconds behaviours{0};  // turns of behaviours; in lockstep also waiting for
                                           // behaviours
  std::chrono::nanoseconds devices{0};     // actuators, radios and other devices
  std::chrono::nanoseconds bodies{0};      // motion and contacts
  std::chrono::nanoseconds observers{0};   // recorders and viewers
  std::chrono::nanoseconds idle{0};        // in real time: waiting until the step was due
  // The robot whose behaviour delayed the step. This is the last robot for which the step waited.
  // If the step waited for no robot, it is the robot with the longest turn. Empty if no behaviour
  // delayed the step.
  std::string held_up_by;

  std::chrono::nanoseconds total() const {
    return behaviours + devices + bodies + observers + idle;
  }
};

// The interface of an object that receives the snapshots and events of a simulation.
class Observer {
 public:
  virtual ~Observer() = default;
  // Whether OnTimes() shall be called. The result must always be the same. Steps are timed only if
  // wants_times() of at least one observer returns true.
  virtual bool wants_times() const { return false; }
  // Receives the times of a step, after OnSnapshot(), on the stepping thread.
  virtual void OnTimes(const StepTimes&) {}
  virtual void OnSnapshot(const std::shared_ptr<const world::Snapshot>& snapshot) = 0;
  virtual void OnEvent(const Event& event) = 0;
};

}  // namespace gsv::simulation
