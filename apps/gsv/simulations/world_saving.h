// Saves the current world of a simulation: as SDFormat for Gazebo and GSV, with a scenario for
// everything that SDFormat cannot express.
//
// The SDFormat text has the models with their current poses (formats/world_writer.h). The scenario
// names this file as its world. The scenario also has the behaviours, the avatars, and each robot
// whose movement or drive was chosen when the robot was added.
#pragma once

#include <string>

#include "gsv/formats/sdf/read_options.h"
#include "gsv/gateway/program/simulation_factory.h"

namespace gsv::app {

// `file` is the name of the world's file in the scenario. Velocities and joint positions are not
// saved.
base::Result<gateway::SimulationFactory::SavedWorld> SaveWorld(
    const simulation::Simulation& simulation, const std::string& file,
    const formats::ReadOptions& options);

}  // namespace gsv::app
