// Updates the health of a simulation's robots, and reads the range sensors of robots that do not
// move.
//
// Bounded  the number of readings per update. A robot that stands still keeps its last reading,
//          which is renewed every 5 s of simulated time.
// Threads  one at a time.
#pragma once

#include <functional>
#include <map>
#include <string>

#include "gsv/health/health.h"
#include "gsv/simulation/simulation.h"

namespace gsv::health {

// Access to the sensors of robots. A reading must not change the simulation.
struct SensorAccess {
  // returns the sensors of a robot
  std::function<std::vector<model::SensorDescription>(const std::string& robot)> sensors;
  std::function<base::Result<sensing::Reading>(const std::string& robot, const std::string& sensor)>
      // takes a reading of a sensor
      read;
  const sensing::SensorRegistry* types = nullptr;  // never null
};

// Reads sensors through Simulation::Watch(). `simulation` must outlive the result.
SensorAccess SensorsOf(simulation::Simulation& simulation);

// Returns the shortest distance that the robot's range sensors (sonars, lidars, …) measure, if it
// is below 1 m.
std::optional<Limit> FindLimit(const std::string& robot, const SensorAccess& access);

// Computes health reports. It keeps the last sensor reading of each robot that does not move.
class HealthTracker {
 public:
  // `robots_read` is the maximum number of robots whose sensors one update reads.
  explicit HealthTracker(std::size_t robots_read = 64) : robots_read_(robots_read) {}

  // Computes the report for this status. `stuck_after` is the time without motion after which a
  // commanded robot is stuck.
  Report Update(const simulation::SimulationStatus& status, base::SimTime stuck_after,
                const SensorAccess& access);

 private:
  struct Known {
    State state = State::kMoving;
    base::SimTime since{0}, read_at{0};  // start of `state`; time of the last reading
    std::optional<Limit> limit;
  };
  const std::size_t robots_read_;
  // The last reading, by the robot's name; only for robots that do not move.
  std::map<std::string, Known> known_;
};

// Returns the current health. Reads the sensors of at most 500 robots.
Report HealthNow(simulation::Simulation& simulation);

}  // namespace gsv::health
