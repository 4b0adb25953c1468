// RobotBeams publishes the live topics /gsv/beams/ROBOT: the sensor beams of one robot. (/gsv/beams
// has the beams of all robots.) Only robots whose topics were requested have this topic
// (WantedRobots). A viewer of a crowd draws only the beams of the selected robot, which are a small
// part of /gsv/beams.
//
// Threads  one thread. Worker threads read the sensors.
#pragma once

#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "gsv/gateway/foxglove/hub.h"
#include "gsv/gateway/live/pacing.h"
#include "gsv/gateway/server/worker_pool.h"
#include "gsv/sensing/registry.h"
#include "gsv/simulation/simulation.h"

namespace gsv::gateway {

// Publishes the live topics /gsv/beams/ROBOT.
class RobotBeams {
 public:
  // A sensor with beams.
  struct Source {
    std::string sensor;  // name of the sensor
    const sensing::SensorType* type = nullptr;
    std::shared_ptr<const sensing::Sensor> made;  // the sensor itself
  };
  using Sources = std::map<std::string, std::vector<Source>>;  // by robot

  // `workers` must outlive the last Publish().
  RobotBeams(std::shared_ptr<Hub> hub, WorkerPool& workers)
      : hub_(std::move(hub)), workers_(workers) {}

  // Returns the robots whose beams have subscribers.
  std::set<std::string> SubscribedRobots() const;

  // Adds a topic for each of these robots. The topics of earlier robots are kept.
  void Refresh(const Sources& sources);

  // Starts to read the beams that have subscribers and are due.
  void Publish(const std::shared_ptr<simulation::Simulation>& simulation,
               const std::shared_ptr<const world::Snapshot>& snapshot, WallTime now);

 private:
  // The topic of one robot, and the state of its readings.
  struct Robot;

  void Publish(const std::shared_ptr<simulation::Simulation>& simulation,
               const std::shared_ptr<const world::Snapshot>& snapshot, WallTime now,
               const std::shared_ptr<Robot>& robot);

  const std::shared_ptr<Hub> hub_;
  WorkerPool& workers_;
  std::map<std::string, std::shared_ptr<Robot>> robots_;
};

}  // namespace gsv::gateway
