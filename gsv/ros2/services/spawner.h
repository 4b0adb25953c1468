// Gives the services the models and worlds of the program; adds models for SpawnEntity.
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

struct SpawnRequest {
  std::string uri;   // in the form of Spawnable::uri, or the file of a model
  std::string name;  // empty for the model's name, with a number if that exists already
  geometry::Pose world_from_entity;
  bool on_ground = false;  // whether it is put on the floor; the height is then ignored
};

class Spawner {
 public:
  struct Spawnable {
    std::string uri;  // "model://pebble"
    bool is_robot = false;
  };

  struct World {
    std::string name;  // a name as for `gsv run`
    std::string uri;   // its file
  };

  virtual ~Spawner() = default;
  virtual std::vector<World> Worlds() = 0;
  virtual std::vector<Spawnable> Spawnables() = 0;
  // Adds a robot, or an object, for which a running simulation is paused and resumed. Returns its name. Fails with kNotFound if there is no such model, with kCorrupt if its file
  // is refused, with kInvalidArgument if this kind of URI is not accepted, and else as Simulation::AddRobot()
  // or AddObject() does.
  virtual base::Result<std::string> Spawn(simulation::Simulation& simulation,
                                          const SpawnRequest& request) = 0;
};

}  // namespace gsv::ros2
