// Publishes simulations that viewers create to ROS 2 nodes, as their scenarios' key `ros2` says.
//
// Threads  any.
#pragma once

#include <memory>

#include "gsv/base/error.h"
#include "gsv/gateway/program/simulation_factory.h"
#include "gsv/ros2/options.h"
#include "gsv/scenario/scenario.h"
#include "gsv/simulation/simulation.h"

namespace gsv::app {

class Ros2Publisher {
 public:
  virtual ~Ros2Publisher() = default;

  virtual gateway::SimulationFactory::Ros2Support Support() = 0;
  // The options of a scenario with the key `ros2`. Fails if they are wrong, or if this process cannot publish it now.
  virtual base::Result<ros2::Options> OptionsOf(const scenario::Scenario& scenario) = 0;
  // From here on the simulation is published, until it is removed. Fails if another one is.
  virtual base::Status Publish(const std::shared_ptr<simulation::Simulation>& simulation,
                               ros2::Options options) = 0;
};

}  // namespace gsv::app
