// Describes the bodies of a simulation and their looks as JSON for viewers (docs/formats/live.md).
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "gsv/simulation/simulation.h"

namespace gsv::presentation {

// Returns the identifier under which a model's GLB can be fetched.
using IdentifyModel = std::function<std::string(const std::shared_ptr<const model::Model>&)>;

// The input from which a scene is made.
struct SceneSource {
  const world::Snapshot& snapshot;
  const sensing::SensorRegistry& sensor_types;
  // Returns the sensors of a robot, avatar or station in the snapshot.
  std::function<std::vector<model::SensorDescription>(const std::string& robot)> sensors;
  IdentifyModel identify;  // returns the identifier of a body's model
  // Returns the identifier of CollisionModel(). If the function is empty, the scene has no
  // collisions.
  IdentifyModel identify_collisions;
};
std::string SceneJson(const SceneSource& source);

// Returns the scene for the simulation's latest snapshot.
std::string SceneJson(const simulation::Simulation& simulation, const IdentifyModel& identify,
                      const IdentifyModel& identify_collisions);

// Returns a model whose visuals are the collision shapes of `model`. Planes are left out, because
// they are unbounded.
model::Model CollisionModel(const model::Model& model);
// Whether CollisionModel() of this model has visuals.
bool HasCollisions(const model::Model& model);

// Returns the bounding box of all visuals except planes. Without visuals, it is a box of 10 m about
// the origin.
geometry::Bounds SceneBounds(const world::Snapshot& snapshot);

}  // namespace gsv::presentation
