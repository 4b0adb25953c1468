// The simulations of one process, by name, with what they share: models, sensor types.
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

// So many simulations at once in one process, if nothing else is said.
inline constexpr std::size_t kDefaultMaxSimulations = 64;

class SimulationHost {
 public:
  SimulationHost(std::shared_ptr<const sensing::SensorRegistry> sensors,
                 std::shared_ptr<formats::ModelLibrary> library,
                 std::size_t max_simulations = kDefaultMaxSimulations)
      : sensors_(std::move(sensors)),
        library_(std::move(library)),
        max_simulations_(max_simulations) {}

  // Reads the world, unless `specification.world` is given, and creates a simulation of it. An
  // empty name is chosen, a taken one is an error. What the files lack is added to `problems`.
  base::Result<std::shared_ptr<simulation::Simulation>> Create(
      simulation::Specification specification, const std::string& world, base::Problems& problems);
  // In no list, and of no effect on the names that are taken: to be looked at.
  // `specification.world` is given.
  base::Result<std::shared_ptr<simulation::Simulation>> CreateUnlisted(
      simulation::Specification specification) const {
    return simulation::Simulation::Create(std::move(specification), sensors_);
  }
  // Removes it from the list; it ends when nobody holds it any more.
  base::Status Remove(const std::string& name);

  std::shared_ptr<simulation::Simulation> Find(const std::string& name) const;  // may be null
  std::vector<std::shared_ptr<simulation::Simulation>> List() const;  // in order of creation

  formats::ModelLibrary& library() { return *library_; }

 private:
  base::Result<std::string> FreeName(std::string wanted) const GSV_REQUIRES(mutex_);

  const std::shared_ptr<const sensing::SensorRegistry> sensors_;
  const std::shared_ptr<formats::ModelLibrary> library_;
  const std::size_t max_simulations_;
  mutable base::Mutex mutex_;
  std::vector<std::shared_ptr<simulation::Simulation>> simulations_ GSV_GUARDED_BY(mutex_);
};

}  // namespace gsv::services
