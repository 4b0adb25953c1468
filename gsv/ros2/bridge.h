// Connects one simulation to ROS 2: publishes the robots' sensors, receives commands, and offers
// the services that control the simulation.
//
// Threads  one publisher thread, one thread for slow sensors, and those of the
//          services; members from any thread. The stepping thread only hands
//          over snapshots. In lockstep it waits for the publisher, never for a
//          reader.
#pragma once

#include <memory>

#include "gsv/ros2/dds/participant.h"
#include "gsv/ros2/options.h"
#include "gsv/ros2/services/spawner.h"
#include "gsv/simulation/simulation.h"

namespace gsv::ros2 {

class Bridge {
 public:
  // `participant` must outlive the bridge, and watch endpoints. `spawner` must outlive it too;
  // without one (null), SpawnEntity is not supported. The bridge does not keep the simulation
  // alive.
  static std::unique_ptr<Bridge> Start(dds::Participant& participant, Options options,
                                       const std::shared_ptr<simulation::Simulation>& simulation,
                                       Spawner* spawner = nullptr);
  virtual ~Bridge() = default;
};

}  // namespace gsv::ros2
