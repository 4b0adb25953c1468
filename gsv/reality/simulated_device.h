// A simulated robot with sensors in a static world. The sensors are read at given poses of the
// robot, such as the poses of a real robot.
//
// Determinism  Read() is a function of the seed, the description, the pose and the step.
// Threads      one at a time.
#pragma once

#include <memory>
#include <vector>

#include "gsv/base/error.h"
#include "gsv/model/world_description.h"
#include "gsv/reality/logs/log.h"
#include "gsv/sensing/sensor.h"

namespace gsv::reality {

class SimulatedDevice {
 public:
  // `sensors` are mounted on the base of one robot. Returns kInvalidArgument for invalid
  // parameters.
  static base::Result<SimulatedDevice> Create(const model::WorldDescription& world,
                                              std::vector<model::SensorDescription> sensors,
                                              std::uint64_t seed);

  // Returns the readings of all sensors, one after the other, for a robot at `pose`.
  std::vector<double> Read(const TimedPose& pose, std::int64_t step);

 private:
  // the world and the robot at the start; Read() moves a copy
  std::shared_ptr<world::Snapshot> first_;
  int body_ = -1;  // index of the robot in the layout
  std::uint64_t seed_ = 0;
  std::vector<std::unique_ptr<sensing::Sensor>> sensors_;
  std::unique_ptr<sensing::RaySceneCache> rays_;
};

// Returns the sensors that correspond to a log's scans: one lidar, or a sonar for each beam.
// `parameters` override the preset. An empty preset means none.
std::vector<model::SensorDescription> SensorsOf(const Log& log, const std::string& preset,
                                                const model::Parameters& parameters, double height);

}  // namespace gsv::reality
