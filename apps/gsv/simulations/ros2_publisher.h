// Publishes simulations that viewers create to ROS 2 nodes, if their scenarios have the key `ros2`.
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

  // Returns whether simulations can be published, and else the reason.
  virtual gateway::SimulationFactory::Ros2Support Support() = 0;
  // Returns the options of a scenario with the key `ros2`. Fails if they cannot be used.
  virtual base::Result<ros2::Options> OptionsOf(const scenario::Scenario& scenario) = 0;
  // Publishes the simulation until it is removed. Fails if another simulation is published.
  virtual base::Status Publish(const std::shared_ptr<simulation::Simulation>& simulation,
                               ros2::Options options) = 0;
};

}  // namespace gsv::app
