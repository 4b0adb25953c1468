// Adds models to a simulation for ROS 2's SpawnEntity.
#pragma once

#include <string>
#include <vector>

#include "gsv/formats/sdf_reader.h"
#include "gsv/gateway/program/simulation_factory.h"
#include "gsv/ros2/services/spawner.h"

namespace gsv::app {

class Ros2Spawner final : public ros2::Spawner {
 public:
  // Both outlive this. `reads_files`: a URI may also name a file. That is for clients of this machine only, because
  // others could make gsv read any of the user's files.
  Ros2Spawner(gateway::SimulationFactory& factory, formats::ModelLibrary& library, bool reads_files)
      : factory_(factory), library_(library), reads_files_(reads_files) {}

  std::vector<World> Worlds() override;
  std::vector<Spawnable> Spawnables() override;
  base::Result<std::string> Spawn(simulation::Simulation& simulation,
                                  const ros2::SpawnRequest& request) override;

 private:
  // The name or the file of a model.
  base::Result<std::string> ModelOf(const std::string& uri);

  gateway::SimulationFactory& factory_;
  formats::ModelLibrary& library_;
  const bool reads_files_;
};

}  // namespace gsv::app
