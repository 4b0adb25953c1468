// What stands in a simulation and how it looks, as JSON for a viewer (docs/formats/live.md).
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "gsv/simulation/simulation.h"

namespace gsv::presentation {

// The identifier under which a model's GLB can be fetched.
using IdentifyModel = std::function<std::string(const std::shared_ptr<const model::Model>&)>;

// What a scene tells of.
struct SceneSource {
  const world::Snapshot& snapshot;
  const sensing::SensorRegistry& sensor_types;
  // Those on a robot, avatar or station of the snapshot.
  std::function<std::vector<model::SensorDescription>(const std::string& robot)> sensors;
  IdentifyModel identify;
  // Of what the model collides with, as CollisionModel() gives it; empty: there is nothing.
  IdentifyModel identify_collisions;
};
std::string SceneJson(const SceneSource& source);

// The scene at the simulation's latest snapshot.
std::string SceneJson(const simulation::Simulation& simulation, const IdentifyModel& identify,
                      const IdentifyModel& identify_collisions);

// A model that looks as the given one collides: planes, which have no end, are left out.
model::Model CollisionModel(const model::Model& model);
bool HasCollisions(const model::Model& model);

// The box around what can be seen of the bodies, planes left out; a box of 10 m about the origin
// where there is nothing else.
geometry::Bounds SceneBounds(const world::Snapshot& snapshot);

}  // namespace gsv::presentation
