// What stands in a simulated world: its bodies in canonical order. Changes only when something is
// added or removed; between such changes every snapshot shares one Layout.
//
// Determinism  bodies are ordered by name, so that the order in which they were added leaves no
//              trace in any loop over them.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "gsv/model/world_description.h"

namespace gsv::world {

// Who moves a body.
enum class BodyKind : std::uint8_t {
  kStatic,      // nobody: it is part of the world
  kUnmoved,     // nobody, though it is not static: it has no drive and collides with nothing
  kPlanarBase,  // its drive, by planar kinematics
  kAvatar,      // a person, by planar kinematics
  kRigidBody,   // rigid-body dynamics: it falls, tips, is pushed, its joints move
  kActor,       // its script alone: nothing stops it, and it stops whatever runs into it
  kPedestrian,  // the social force model, by planar kinematics
};

struct Pedestrian;  // gsv/world/pedestrian.h

// Who moves a body of this model, unless a person does. `movement` is that of a model with a drive;
// without one a body can only be moved by rigid-body dynamics.
BodyKind KindOf(const model::Model& model, bool is_static, model::Movement movement);
// The same of a model as its world's file has it.
BodyKind KindOf(const model::PlacedModel& placed);

// One placed model. `first_joint` and `first_link` place its joints and links in the arrays that
// hold those of all bodies.
struct Body {
  std::string name;
  std::shared_ptr<const model::Model> model;
  geometry::Pose initial_pose;  // world_from_model when the simulation starts
  BodyKind kind = BodyKind::kUnmoved;
  std::shared_ptr<const Pedestrian> pedestrian;  // of kPedestrian; else null

  bool is_static() const { return kind == BodyKind::kStatic; }
  bool is_avatar() const { return kind == BodyKind::kAvatar; }
  bool is_rigid() const { return kind == BodyKind::kRigidBody; }
  bool is_actor() const { return kind == BodyKind::kActor; }
  bool is_pedestrian() const { return kind == BodyKind::kPedestrian; }
  // Moved by planar kinematics.
  bool is_planar() const { return kind == BodyKind::kPlanarBase || is_avatar() || is_pedestrian(); }
  // May be given a behaviour, or is steered by a person.
  bool is_robot() const {
    return kind == BodyKind::kPlanarBase || is_avatar() || (is_rigid() && model->drive.has_value());
  }

  int first_joint = 0;
  int first_link = 0;
};

struct Layout {
  std::uint32_t version = 0;  // grows with each change
  std::vector<Body> bodies;   // by name, ascending
  int joint_count = 0;
  int link_count = 0;
  std::shared_ptr<const model::WorldDescription> description;  // light, sky, gravity; never null

  // Index of the body of that name, or -1.
  int Find(std::string_view name) const;
};

// Orders `bodies` by name and numbers their joints and links. Names must be unique.
std::shared_ptr<const Layout> MakeLayout(
    std::uint32_t version, std::vector<Body> bodies,
    std::shared_ptr<const model::WorldDescription> description);

}  // namespace gsv::world
