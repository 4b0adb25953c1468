// The bodies of a simulated world in canonical order. Snapshots share one Layout until it changes:
// until a body is added or removed, or an initial pose or the gravity is changed.
//
// Determinism  bodies are ordered by name, so that loops over them do not depend on the order of
//              insertion.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "gsv/model/world_description.h"

namespace gsv::world {

// How a body moves.
enum class BodyKind : std::uint8_t {
  kStatic,  // never moves, such as a wall
  // Not static, but nothing moves it: it has no drive and no collisions. Also, it has no joint to
  // the world, or none of its joints can move.
  kUnmoved,
  kPlanarBase,  // planar kinematics, by its drive
  kAvatar,      // planar kinematics, driven by a user
  kRigidBody,   // rigid-body dynamics: it can fall, tip over and be pushed, and its joints move
  kActor,       // moved by a script; nothing stops it, but it stops bodies that collide with it
  kPedestrian,  // planar kinematics by the social force model
};

struct Pedestrian;  // gsv/world/pedestrian.h

// Returns the kind of a body of this model; not for avatars. `movement` applies only to a model
// with a drive, because a body without a drive can only be moved by rigid-body dynamics.
BodyKind KindOf(const model::Model& model, bool is_static, model::Movement movement);
// Returns the kind of a body for a model of a world file.
BodyKind KindOf(const model::PlacedModel& placed);

// A placed model. `first_joint` and `first_link` are the indices of its first joint and first link
// in arrays over all bodies.
struct Body {
  std::string name;
  std::shared_ptr<const model::Model> model;
  geometry::Pose initial_pose;  // world_from_model at the start and after a reset
  BodyKind kind = BodyKind::kUnmoved;
  std::shared_ptr<const Pedestrian> pedestrian;  // set for kPedestrian, else null

  bool is_static() const { return kind == BodyKind::kStatic; }
  bool is_avatar() const { return kind == BodyKind::kAvatar; }
  bool is_rigid() const { return kind == BodyKind::kRigidBody; }
  bool is_actor() const { return kind == BodyKind::kActor; }
  bool is_pedestrian() const { return kind == BodyKind::kPedestrian; }
  // Whether the body moves by planar kinematics.
  bool is_planar() const { return kind == BodyKind::kPlanarBase || is_avatar() || is_pedestrian(); }
  // Whether the body may have a behaviour, or is an avatar.
  bool is_robot() const {
    return kind == BodyKind::kPlanarBase || is_avatar() || (is_rigid() && model->drive.has_value());
  }

  int first_joint = 0;
  int first_link = 0;
};

// The list of a world's bodies. The values that change from step to step are in State.
struct Layout {
  std::uint32_t version = 0;  // increases with each change of the layout
  std::vector<Body> bodies;   // ordered by name
  int joint_count = 0;        // number of joints of all bodies
  int link_count = 0;         // number of links of all bodies
  std::shared_ptr<const model::WorldDescription> description;  // light, sky, gravity; never null

  // Returns the index of the body with that name, or -1.
  int Find(std::string_view name) const;
};

// Makes a layout. Sorts `bodies` by name and numbers their joints and links. Names must be unique.
std::shared_ptr<const Layout> MakeLayout(
    std::uint32_t version, std::vector<Body> bodies,
    std::shared_ptr<const model::WorldDescription> description);

}  // namespace gsv::world
