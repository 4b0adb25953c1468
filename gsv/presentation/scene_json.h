// The bodies of a simulation and their looks as JSON for viewers (docs/formats/live.md).
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "gsv/simulation/simulation.h"

namespace gsv::presentation {

// Returns the identifier under which a model's GLB can be fetched.
using IdentifyModel = std::function<std::string(const std::shared_ptr<const model::Model>&)>;

// The data of a scene.
struct SceneSource {
  const world::Snapshot& snapshot;
  const sensing::SensorRegistry& sensor_types;
  // The sensors of a robot, avatar or station of the snapshot.
  std::function<std::vector<model::SensorDescription>(const std::string& robot)> sensors;
  IdentifyModel identify;
  // Returns the identifier of CollisionModel(); empty: the scene has no collisions.
  IdentifyModel identify_collisions;
};
std::string SceneJson(const SceneSource& source);

// Returns the scene at the simulation's latest snapshot.
std::string SceneJson(const simulation::Simulation& simulation, const IdentifyModel& identify,
                      const IdentifyModel& identify_collisions);

// Returns a model whose visuals are the collision shapes of the given one. Planes are left out,
// because they are unbounded.
model::Model CollisionModel(const model::Model& model);
bool HasCollisions(const model::Model& model);

// Returns the bounding box of all visuals except planes; without any, 10 m about the origin.
geometry::Bounds SceneBounds(const world::Snapshot& snapshot);

}  // namespace gsv::presentation
