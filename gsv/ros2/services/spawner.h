// The interface through which the services add models (SpawnEntity) and load worlds (LoadWorld).
// The program that runs the services implements it.
// Threads  one at a time. Calls may take seconds, because they read models.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "gsv/base/error.h"
#include "gsv/geometry/pose.h"
#include "gsv/simulation/simulation.h"

namespace gsv::ros2 {

// The entity that SpawnEntity requests.
struct SpawnRequest {
  std::string uri;   // in the form of Spawnable::uri, or the file of a model
  std::string name;  // if empty: the model's name, with a number if this name is in use
  geometry::Pose world_from_entity;
  // Whether the entity is put on the floor. The height of its pose is then ignored.
  bool on_ground = false;
};

class Spawner {
 public:
  // A model that clients can add.
  struct Spawnable {
    std::string uri;        // "model://pebble"
    bool is_robot = false;  // whether the model has a drive
  };

  // A world that clients can load.
  struct World {
    std::string name;  // a name that `gsv run` accepts
    std::string uri;   // the file of the world
  };

  // A pose in the world that has a name, for clients to place entities.
  struct NamedPose {
    std::string name;
    geometry::Pose world_from_pose;
  };

  virtual ~Spawner() = default;
  // Returns the worlds that clients can load.
  virtual std::vector<World> Worlds() = 0;
  // Returns the models that clients can add.
  virtual std::vector<Spawnable> Spawnables() = 0;
  // Adds a robot or an object, and returns its name. To add an object, a running simulation is
  // paused, and then resumed. Fails with kNotFound if there is no such model, with kCorrupt if the
  // model's file is refused, and with kInvalidArgument if this kind of URI is not accepted. Other
  // errors are those of Simulation::AddRobot() and AddObject().
  virtual base::Result<std::string> Spawn(simulation::Simulation& simulation,
                                          const SpawnRequest& request) = 0;
  // Returns the named poses of the world's file.
  virtual base::Result<std::vector<NamedPose>> NamedPoses(
      const simulation::Simulation& simulation) = 0;

  // Whether the program can change the world that it publishes.
  virtual bool loads_worlds() const = 0;
  // Replaces the published simulation by a new simulation of this world (World::name, World::uri,
  // or another file). The new simulation is not started. If this fails, the published simulation is
  // kept. Fails with kNotFound if there is no such world, with kBadModel if the world's file is
  // refused, and with kInvalidArgument if this kind of URI is not accepted. If `is_strict`, also
  // fails with kCorrupt if the file causes warnings.
  virtual base::Status LoadWorld(const std::string& uri, bool is_strict) = 0;
  // Ends the published simulation.
  virtual base::Status UnloadWorld() = 0;
};

}  // namespace gsv::ros2
