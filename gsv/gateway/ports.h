// What the gateway needs from the program around it.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "gsv/simulation/simulation.h"

namespace gsv::gateway {

// The simulations that can be watched.
//
// Threads  both may be called from any thread, and return at once.
class SimulationDirectory {
 public:
  virtual ~SimulationDirectory() = default;

  // In the order in which a person should see them; the first is what a viewer opens by default.
  virtual std::vector<std::shared_ptr<simulation::Simulation>> List() = 0;
  // Null if there is none of that name.
  virtual std::shared_ptr<simulation::Simulation> Find(const std::string& name) = 0;
};

}  // namespace gsv::gateway
