// Computes the quantities of expectations (scenario::Quantity) from the states of a run.
//
// Threads  one at a time.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "gsv/scenario/expectation.h"
#include "gsv/simulation/history/motion_history.h"
#include "gsv/simulation/simulation.h"

namespace gsv::verdict {

// Returns a text such as "the distance between scout and crate".
std::string Describe(const scenario::Quantity& quantity);
// Returns the unit with a blank in front, such as " m", or an empty text.
const char* UnitOf(const scenario::Quantity& quantity);

// Measures quantities at one state of a simulation.
class Measure {
 public:
  // `simulation` must outlive this object.
  explicit Measure(simulation::Simulation& simulation) : simulation_(simulation) {}

  // Fails if the body, sensor or behaviour of the quantity is unknown, and for a quantity of a
  // camera.
  base::Status Check(const scenario::Quantity& quantity) const;

  // Sets the snapshot at which Of() measures. It must be the simulation's latest snapshot.
  void MoveTo(std::shared_ptr<const world::Snapshot> snapshot);
  // Returns the value; nullopt if there is none, for example because the body was removed or the
  // sensor fails.
  std::optional<double> Of(const scenario::Quantity& quantity);
  // Returns the robot that has not moved for the longest time although it was commanded to move;
  // empty if there is none.
  std::string stuck_longest() const;

 private:
  // Returns the state of a body; null if it is not in the world.
  const world::BodyState* StateOf(const std::string& body) const;
  // Returns the values of a sensor's reading without the intensities of a lidar.
  std::span<const double> WithoutIntensities(const scenario::Quantity& quantity,
                                             const sensing::Reading::Values& values) const;
  // The values of Kind::kSensor and Kind::kContact, see Quantity.
  std::optional<double> OfSensor(const scenario::Quantity& quantity) const;
  std::optional<double> OfContact(const scenario::Quantity& quantity) const;
  // Whether the robot's behaviour has finished, died or become unresponsive.
  bool HasEnded(const std::string& robot);
  // Returns the value of kStuck for one body, s.
  double SecondsStuck(int body) const;
  std::optional<double> OfStuck(const std::string& robot) const;

  simulation::Simulation& simulation_;
  std::shared_ptr<const world::Snapshot> snapshot_;
  simulation::MotionHistory motions_;  // the motion of all robots up to snapshot_
  // The newest status that HasEnded() has read while the run was not over.
  std::optional<simulation::SimulationStatus> status_;
  bool is_status_new_ = false;  // whether HasEnded() has read the status at the current snapshot
};

}  // namespace gsv::verdict
