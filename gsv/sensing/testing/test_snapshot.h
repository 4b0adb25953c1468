// Snapshots of small worlds, for tests.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "gsv/world/snapshot.h"

namespace gsv::sensing::testing {

inline std::shared_ptr<model::Model> ModelOf(const geometry::Shape& shape) {
  auto model = std::make_shared<model::Model>();
  model->name = "model";
  model::Collision collision;
  collision.shape = shape;
  model->links.resize(1);
  model->links[0].collisions.push_back(collision);
  return model;
}

// A body of the snapshot.
struct Placed {
  std::string name;
  std::shared_ptr<const model::Model> model;
  geometry::Pose pose;
  bool is_static = true;
};

inline std::shared_ptr<world::Snapshot> MakeSnapshot(const std::vector<Placed>& placed) {
  std::vector<world::Body> bodies;
  for (const Placed& p : placed) {
    world::Body body;
    body.name = p.name;
    body.model = p.model;
    body.initial_pose = p.pose;
    body.kind = p.is_static ? world::BodyKind::kStatic : world::BodyKind::kUnmoved;
    bodies.push_back(body);
  }
  auto snapshot = std::make_shared<world::Snapshot>();
  snapshot->layout = world::MakeLayout(1, bodies, std::make_shared<model::WorldDescription>());
  snapshot->state = world::InitialState(*snapshot->layout);
  return snapshot;
}

}  // namespace gsv::sensing::testing
