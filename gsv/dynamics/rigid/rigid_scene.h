// The rigid engine's view of a layout: rigid bodies, their shapes and the other bodies. Private to
// this folder: it includes Bullet.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "gsv/base/error.h"
#include "gsv/dynamics/motion/articulation.h"
#include "gsv/dynamics/motion/drive_kinematics.h"
#include "gsv/dynamics/motion/medium_forces.h"
#include "gsv/dynamics/motion/wheel_slip.h"
#include "gsv/dynamics/rigid/rigid_shapes.h"
#include "gsv/world/state.h"

namespace gsv::dynamics {

// A collision shape with its surface properties.
struct Solid {
  int body = 0;                          // index in the layout
  btCollisionShape* shape = nullptr;     // never null
  std::vector<model::Surface> surfaces;  // surfaces of the children of a compound, else one surface
  double thickness = 1;  // half of the thinnest child's least extent, if that is less than 1 m
  double radius = 0;     // about the origin of the shape's frame
  std::optional<RollingWheel> wheel;  // set for a part that rolls

  bool bounces() const;
};

// A body that rigid-body dynamics moves.
struct RigidBody {
  int body = 0;
  const model::Model* model = nullptr;
  Articulation articulation;
  std::vector<Solid> solids;      // the solids of its parts
  std::vector<PartMedium> media;  // the media of its parts; empty if no medium pushes it
  std::optional<DriveKinematics> kinematics;
  int first_joint = 0;
  bool is_jointed() const { return articulation.parts.size() > 1; }
};

// A body whose pose in the state does not change.
struct StandingBody {
  Solid solid;
  geometry::Pose model_from_shape;
};

// The box that a rigid body may reach within a step.
struct Area {
  btVector3 low, high;
};
// Whether a planar body comes near one of the areas while it moves from `before` to `after`.
bool IsNear(const Solid& planar, const world::State& before, const world::State& after,
            const std::vector<Area>& areas);

class RigidScene {
 public:
  // Refuses drives that make no sense.
  base::Status SetLayout(std::shared_ptr<const world::Layout> layout);

  bool has_bodies() const { return !bodies_.empty(); }
  const world::Layout& layout() const { return *layout_; }
  const std::vector<RigidBody>& bodies() const { return bodies_; }
  const std::vector<StandingBody>& standing() const { return standing_; }
  // Bodies that planar kinematics and scripts move. They are obstacles to others, with the shapes of
  // their footprints (of actors: of their collisions).
  const std::vector<Solid>& planar() const { return planar_; }

 private:
  base::Status AddRigid(int index);
  void AddStanding(int index);
  void AddPlanar(int index);
  void AddActor(int index);

  std::shared_ptr<const world::Layout> layout_;
  RigidShapes shapes_;
  std::vector<RigidBody> bodies_;
  std::vector<StandingBody> standing_;
  std::vector<Solid> planar_;
};

}  // namespace gsv::dynamics
