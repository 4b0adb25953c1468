// Data that the rigid engine derives from a layout: the rigid bodies, their shapes, and the other
// bodies as obstacles. Private to this folder: it includes Bullet.
#pragma once

#include <memory>
#include <vector>

#include "gsv/base/error.h"
#include "gsv/dynamics/rigid/rigid_body.h"
#include "gsv/dynamics/rigid/rigid_shapes.h"
#include "gsv/world/state.h"

namespace gsv::dynamics {

// A box around all places that a rigid body may reach within a step.
struct Area {
  geometry::Vector3 low, high;  // smallest and largest coordinates in the world, m
};
// Whether a planar body comes near one of the areas while it moves from `before` to `after`.
bool IsNear(const Solid& planar, const world::State& before, const world::State& after,
            const std::vector<Area>& areas);

// The bodies of a layout, as rigid-body dynamics uses them.
class RigidScene {
 public:
  // Rejects invalid drives.
  base::Status SetLayout(std::shared_ptr<const world::Layout> layout);

  bool has_bodies() const { return !bodies_.empty(); }
  const world::Layout& layout() const { return *layout_; }
  const std::vector<RigidBody>& bodies() const { return bodies_; }
  // The solids of bodies that do not move. The frame of a solid is the frame of its model.
  const std::vector<Solid>& standing() const { return standing_; }
  // The solids of bodies that planar kinematics and scripts move. They are obstacles for rigid
  // bodies. A planar body has the shape of its footprint, and an actor has its collision shapes.
  const std::vector<Solid>& planar() const { return planar_; }

 private:
  // Adds a body of the layout to bodies_, by its index.
  base::Status AddRigid(int index);
  // Adds a body of the layout to standing_.
  void AddStanding(int index);
  // Adds a body of the layout to planar_.
  void AddPlanar(int index);
  // Adds an actor of the layout to planar_.
  void AddActor(int index);

  std::shared_ptr<const world::Layout> layout_;
  RigidShapes shapes_;
  std::vector<RigidBody> bodies_;
  std::vector<Solid> standing_;  // solids of bodies that do not move
  std::vector<Solid> planar_;    // solids of bodies that planar kinematics and scripts move
};

}  // namespace gsv::dynamics
