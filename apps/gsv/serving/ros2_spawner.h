// Adds models to a simulation for ROS 2's SpawnEntity, and creates simulations for LoadWorld.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "gsv/formats/sdf_reader.h"
#include "gsv/gateway/program/simulation_factory.h"
#include "gsv/ros2/services/spawner.h"

namespace gsv::app {

class Ros2Spawner final : public ros2::Spawner {
 public:
  // `factory` and `library` must outlive this object. With `reads_files`, a URI may also name a
  // file. Set it only if all clients are on this machine, because other clients could read any file
  // of the user.
  Ros2Spawner(gateway::SimulationFactory& factory, formats::ModelLibrary& library, bool reads_files)
      : factory_(factory), library_(library), reads_files_(reads_files) {}

  // Publishes the argument if it is not null. Then ends the simulation that was published before.
  // Fails with kNotFound if there is neither.
  using Replace = std::function<base::Status(const std::shared_ptr<simulation::Simulation>&)>;
  // Lets clients load worlds. Call it before there are clients.
  void AllowLoadingWorlds(Replace replace) { replace_ = std::move(replace); }

  std::vector<World> Worlds() override;
  std::vector<Spawnable> Spawnables() override;
  base::Result<std::string> Spawn(simulation::Simulation& simulation,
                                  const ros2::SpawnRequest& request) override;
  base::Result<std::vector<NamedPose>> NamedPoses(
      const simulation::Simulation& simulation) override;
  bool loads_worlds() const override { return static_cast<bool>(replace_); }
  base::Status LoadWorld(const std::string& uri, bool is_strict) override;
  base::Status UnloadWorld() override;

 private:
  // Returns the name or the file of a world.
  base::Result<std::string> WorldOf(const std::string& uri);
  // Returns the file that a URI names. Fails if files may not be read, or if the file does not
  // exist.
  base::Result<std::string> FileOf(const std::string& uri) const;
  // Returns the name or the file of a model.
  base::Result<std::string> ModelOf(const std::string& uri);

  gateway::SimulationFactory& factory_;
  formats::ModelLibrary& library_;
  const bool reads_files_;
  Replace replace_;  // empty: worlds cannot be loaded
};

}  // namespace gsv::app
