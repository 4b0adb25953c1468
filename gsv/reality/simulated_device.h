// A simulated sensor, read wherever a real one stood, in a world that does not move.
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
  // `sensors` are mounted on one robot's base; each is read. kInvalidArgument for parameters that
  // are refused.
  static base::Result<SimulatedDevice> Create(const model::WorldDescription& world,
                                              std::vector<model::SensorDescription> sensors,
                                              std::uint64_t seed);

  // The values of all sensors, one after the other, with the base at `pose`.
  std::vector<double> Read(const TimedPose& pose, std::int64_t step);

 private:
  std::shared_ptr<world::Snapshot> first_;
  int body_ = -1;
  std::uint64_t seed_ = 0;
  std::vector<std::unique_ptr<sensing::Sensor>> sensors_;
  std::unique_ptr<sensing::RaySceneCache> rays_;
};

// The sensors that a log's scans were measured with: one lidar, or a sonar for each beam.
// `parameters` win over the preset (empty: none).
std::vector<model::SensorDescription> SensorsOf(const Log& log, const std::string& preset,
                                                const model::Parameters& parameters, double height);

}  // namespace gsv::reality
