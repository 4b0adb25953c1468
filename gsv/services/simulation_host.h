// The simulations of one process, by name. They share models and sensor types.
//
// Threads  any.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "gsv/base/mutex.h"
#include "gsv/formats/sdf_reader.h"
#include "gsv/sensing/registry.h"
#include "gsv/simulation/simulation.h"

namespace gsv::services {

// The default maximum of simulations per process.
inline constexpr std::size_t kDefaultMaxSimulations = 64;

// The list of simulations that this process runs.
class SimulationHost {
 public:
  SimulationHost(std::shared_ptr<const sensing::SensorRegistry> sensors,
                 std::shared_ptr<formats::ModelLibrary> library,
                 std::size_t max_simulations = kDefaultMaxSimulations)
      : sensors_(std::move(sensors)),
        library_(std::move(library)),
        max_simulations_(max_simulations) {}

  // Creates a simulation. If `specification.world` is not set, reads the world first. Chooses a
  // name if the specification has none. Fails if another simulation has the name. Adds problems of
  // the files to `problems`.
  base::Result<std::shared_ptr<simulation::Simulation>> Create(
      simulation::Specification specification, const std::string& world, base::Problems& problems);
  // Creates a simulation for a preview. The simulation is not in the list, and another simulation
  // may have the same name. `specification.world` must be set.
  base::Result<std::shared_ptr<simulation::Simulation>> CreateUnlisted(
      simulation::Specification specification) const {
    return simulation::Simulation::Create(std::move(specification), sensors_);
  }
  // Removes a simulation from the list. The simulation is destroyed when its last user releases it.
  base::Status Remove(const std::string& name);

  // Returns the simulation with this name, or null if there is none.
  std::shared_ptr<simulation::Simulation> Find(const std::string& name) const;
  std::vector<std::shared_ptr<simulation::Simulation>> List() const;  // in order of creation

  formats::ModelLibrary& library() { return *library_; }

 private:
  // Returns `wanted`, or a free name if `wanted` is empty. Fails if the name is taken or invalid,
  // or if there are too many simulations.
  base::Result<std::string> FreeName(std::string wanted) const GSV_REQUIRES(mutex_);

  const std::shared_ptr<const sensing::SensorRegistry> sensors_;
  const std::shared_ptr<formats::ModelLibrary> library_;
  const std::size_t max_simulations_;
  mutable base::Mutex mutex_;
  std::vector<std::shared_ptr<simulation::Simulation>> simulations_ GSV_GUARDED_BY(mutex_);
};

}  // namespace gsv::services
