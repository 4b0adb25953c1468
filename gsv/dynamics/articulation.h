// A model as a tree of rigid parts: links between which nothing can move are one part.
//
// Frames  the model's, at zero joint positions. A part's own frame lies in its centre of mass, with
//         its axes along the principal axes of its inertia.
// Units   kg, kg m², metres.
#pragma once

#include <vector>

#include "gsv/model/model.h"

namespace gsv::dynamics {

struct Part {
  int joint = -1;   // of the model, that moves it against its parent; -1: the base
  int parent = -1;  // a part before this one; -1: the base has none
  std::vector<int> links;
  double mass = 0;
  geometry::Pose model_from_part;
  geometry::Vector3 inertia;  // principal moments
};

struct Articulation {
  std::vector<Part> parts;  // parents before children; the first is the base
  std::vector<int> part_of_link;
  bool is_fixed = false;  // a joint holds a link to the world: the base does not move
  double mass = 0;        // of all parts
};

// Links that hang from no joint belong to the base, which moves with the model's frame, and so does
// what hangs from the world by a joint that is not fixed. Ball and screw joints hold like fixed
// ones.
Articulation MakeArticulation(const model::Model& model);

// Whether the joint moves: revolute, continuous or prismatic.
bool IsMovable(model::JointKind kind);

}  // namespace gsv::dynamics
