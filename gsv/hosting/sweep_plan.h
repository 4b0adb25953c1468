// The plan by which the beams of a robot's open sensors are read together. Robots with equal
// sensors share one plan, so that the plan of a crowd stays in the processor's cache.
//
// Threads  const objects may be used concurrently; Share() by any thread.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "gsv/sensing/beam_set.h"
#include "gsv/simulation/robots/mounted_sensor.h"

namespace gsv::hosting {

struct SweepPlan {
  // The entry in `beam_of` of a sensor that is not read with the beams.
  static constexpr std::size_t kNoBeam = static_cast<std::size_t>(-1);

  // Makes the plan for `sensors`, which must be ordered by name. The plan casts the beams of all
  // sensors with one beam together. A sensor with several beams, noise, an update rate or latency
  // is read separately.
  explicit SweepPlan(const std::vector<std::shared_ptr<simulation::MountedSensor>>& sensors);

  // Whether every sensor is read with the beams.
  bool HasOnlyBeams() const { return beams.size() == names.size(); }

  std::vector<std::string> names;    // names of the sensors
  std::vector<std::size_t> beam_of;  // index of each sensor's beam in `beams`, or kNoBeam
  sensing::BeamSet beams;
};

// Returns an equal plan that another robot uses. If there is no such plan, returns `plan`.
std::shared_ptr<const SweepPlan> Share(std::shared_ptr<const SweepPlan> plan);

}  // namespace gsv::hosting
