// Receives the snapshots and events of a simulation. See Simulation::AddObserver().
//
// Threads  snapshots come from the stepping thread, which holds no lock then, so const members of
//          the simulation may be called. Events come from any thread with locks held, so no member
//          of the simulation may be called. Both functions must return at once.
#pragma once

#include <memory>

#include "gsv/simulation/types.h"
#include "gsv/world/snapshot.h"

namespace gsv::simulation {

class Observer {
 public:
  virtual ~Observer() = default;
  virtual void OnSnapshot(const std::shared_ptr<const world::Snapshot>& snapshot) = 0;
  virtual void OnEvent(const Event& event) = 0;
};

}  // namespace gsv::simulation
