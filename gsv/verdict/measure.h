// Computes the quantities of expectations (scenario::Quantity) from the states of a run.
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
  // `simulation` must outlive the object.
  explicit Measure(simulation::Simulation& simulation) : simulation_(simulation) {}

  // Refuses a quantity of an unknown body, sensor or behaviour, or of a camera.
  base::Status Check(const scenario::Quantity& quantity) const;

  // Evaluates at this state, the latest, from now on.
  void MoveTo(std::shared_ptr<const world::Snapshot> snapshot);
  // The value; nothing if its body was removed or its sensor fails.
  std::optional<double> Of(const scenario::Quantity& quantity);

 private:
  const world::BodyState* StateOf(const std::string& body) const;
  std::optional<double> OfSensor(const scenario::Quantity& quantity) const;
  std::optional<double> OfContact(const scenario::Quantity& quantity) const;
  bool HasEnded(const std::string& robot);

  simulation::Simulation& simulation_;
  std::shared_ptr<const world::Snapshot> snapshot_;
  std::optional<simulation::SimulationStatus> status_;
  bool is_status_new_ = false;  // of the current snapshot
};

}  // namespace gsv::verdict
