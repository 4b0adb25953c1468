// Takes the numbers of a run that expectations are about (scenario::Quantity) from its states.
//
// Threads  one at a time.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>

#include "gsv/scenario/expectation.h"
#include "gsv/simulation/simulation.h"

namespace gsv::verdict {

// "the distance between scout and crate"
std::string Describe(const scenario::Quantity& quantity);
const char* UnitOf(const scenario::Quantity& quantity);  // " m"; empty: none

class Measure {
 public:
  // `simulation` outlives it.
  explicit Measure(simulation::Simulation& simulation) : simulation_(simulation) {}

  // Refuses a quantity of a body, a sensor or a behaviour that is not there, or of a camera.
  base::Status Check(const scenario::Quantity& quantity) const;

  // All that is asked for from now on is of this state, the latest.
  void MoveTo(std::shared_ptr<const world::Snapshot> snapshot);
  // Nothing where it cannot be had: its body is gone, its sensor gives an error.
  std::optional<double> Of(const scenario::Quantity& quantity);

 private:
  const world::BodyState* StateOf(const std::string& body) const;
  std::optional<double> OfSensor(const scenario::Quantity& quantity) const;
  std::optional<double> OfContact(const scenario::Quantity& quantity) const;
  bool HasEnded(const std::string& robot);

  simulation::Simulation& simulation_;
  std::shared_ptr<const world::Snapshot> snapshot_;
  std::optional<simulation::SimulationStatus> status_;
  bool is_status_new_ = false;  // it is of the snapshot
};

}  // namespace gsv::verdict
