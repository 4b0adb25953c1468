// The services ask the program for its models and worlds through this, and SpawnEntity adds a model.
//
// Threads  one at a time. Calls may take seconds: models are read.
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
  std::string name;  // empty: the model's name, numbered if taken
  geometry::Pose world_from_entity;
  bool on_ground = false;  // stands on the floor; the height is ignored
};

class Spawner {
 public:
  struct Spawnable {
    std::string uri;  // "model://pebble"
    bool is_robot = false;
  };

  struct World {
    std::string name;  // as `gsv run` takes it
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
