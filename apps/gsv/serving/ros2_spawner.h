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
  // Both must outlive this. `reads_files`: URIs may also name files. Only for clients on this
  // machine, because other clients could make gsv read any file of the user.
  Ros2Spawner(gateway::SimulationFactory& factory, formats::ModelLibrary& library, bool reads_files)
      : factory_(factory), library_(library), reads_files_(reads_files) {}

  std::vector<World> Worlds() override;
  std::vector<Spawnable> Spawnables() override;
  base::Result<std::string> Spawn(simulation::Simulation& simulation,
                                  const ros2::SpawnRequest& request) override;

 private:
  // Returns the name or the file of a model.
  base::Result<std::string> ModelOf(const std::string& uri);

  gateway::SimulationFactory& factory_;
  formats::ModelLibrary& library_;
  const bool reads_files_;
};

}  // namespace gsv::app
