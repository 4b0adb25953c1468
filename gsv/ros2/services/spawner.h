// The interface through which the services add models (SpawnEntity) and load worlds (LoadWorld).
// The program that runs the services implements it.
//
// Threads  one at a time. Calls may take seconds, because models are read.
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
  // Whether the entity is put on the floor; the height of its pose is then ignored.
  bool on_ground = false;
};

class Spawner {
 public:
  struct Spawnable {
    std::string uri;  // "model://pebble"
    bool is_robot = false;
  };

  struct World {
    std::string name;  // a name that `gsv run` accepts
    std::string uri;   // its file
  };

  struct NamedPose {
    std::string name;
    geometry::Pose world_from_pose;
  };

  virtual ~Spawner() = default;
  virtual std::vector<World> Worlds() = 0;
  virtual std::vector<Spawnable> Spawnables() = 0;
  // Adds a robot or an object, and returns its name. To add an object, a running simulation is
  // paused, and then resumed. Errors: kNotFound if there is no such model; kCorrupt if its file is
  // refused; kInvalidArgument if this kind of URI is not accepted; else those of
  // Simulation::AddRobot() or AddObject().
  virtual base::Result<std::string> Spawn(simulation::Simulation& simulation,
                                          const SpawnRequest& request) = 0;
  // Returns the named poses of the world's file.
  virtual base::Result<std::vector<NamedPose>> NamedPoses(
      const simulation::Simulation& simulation) = 0;

  // Whether the program can change the world that it publishes.
  virtual bool loads_worlds() const = 0;
  // Replaces the published simulation by a new one of this world (World::name, World::uri, or
  // another file), which is not started. The published simulation is kept if this fails.
  // Errors: kNotFound if there is no such world; kBadModel if its file is refused; kInvalidArgument
  // if this kind of URI is not accepted; kCorrupt if `is_strict` and the file gives warnings.
  virtual base::Status LoadWorld(const std::string& uri, bool is_strict) = 0;
  // Ends the published simulation.
  virtual base::Status UnloadWorld() = 0;
};

}  // namespace gsv::ros2
