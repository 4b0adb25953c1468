// Connects one simulation to ROS 2: publishes the robots' sensors, receives commands, and offers
// services that control the simulation.
//
// Threads  one publisher thread, threads for slow sensors, and the threads of the services;
//          members from any thread. The stepping thread only hands over snapshots. In lockstep, it
//          waits for the publisher, but never for a reader.
#pragma once

#include <memory>

#include "gsv/ros2/dds/participant.h"
#include "gsv/ros2/options.h"
#include "gsv/ros2/services/simulation_services.h"
#include "gsv/simulation/simulation.h"

namespace gsv::ros2 {

// The connection of one simulation to ROS 2. Its destructor ends it.
class Bridge {
 public:
  // `participant` and `services` must outlive the bridge. The participant must have been created
  // with ParticipantOptions::watches_endpoints. If `services` is null, the bridge creates its own
  // services, which cannot add models. The bridge does not keep the simulation alive.
  static std::unique_ptr<Bridge> Start(dds::Participant& participant, Options options,
                                       const std::shared_ptr<simulation::Simulation>& simulation,
                                       SimulationServices* services = nullptr);
  // Starts a bridge without a simulation. Only the node /gsv with its services exists then.
  static std::unique_ptr<Bridge> StartWithoutWorld(dds::Participant& participant, Distro distro,
                                                   SimulationServices& services);
  virtual ~Bridge() = default;
};

}  // namespace gsv::ros2
