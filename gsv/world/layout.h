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

// One placed model. `first_joint` and `first_link` place its joints and links in the arrays that
// hold those of all bodies.
struct Body {
  std::string name;
  std::shared_ptr<const model::Model> model;
  geometry::Pose initial_pose;  // world_from_model when the simulation starts
  bool is_static = false;
  bool is_robot = false;   // has a drive and may be given a behaviour
  bool is_avatar = false;  // steered by a person
  bool is_rigid = false;   // moved by forces: falls, tips, is pushed, has joints
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
