// A model as a tree of rigid parts. Links that cannot move relative to each other form one part.
//
// Frames  Poses are in the model's frame, with all joints at zero. The origin of a part's frame is
//         its centre of mass. The axes are the principal axes of its inertia.
// Units   kg, kg m², metres.
#pragma once

#include <array>
#include <vector>

#include "gsv/model/model.h"

namespace gsv::dynamics {

// A rigid part of a model: one or more links that cannot move relative to each other.
struct Part {
  // The joint of the model between this part and its parent; -1 for the base. A ball joint consists
  // of three joints of the model. For a ball joint, `joint` is the last of the three.
  int joint = -1;
  int parent = -1;         // index of the parent part, which precedes this part; -1 for the base
  std::vector<int> links;  // indices of the model's links
  double mass = 0;         // kg
  geometry::Pose model_from_part;  // pose of the part's frame, see above
  geometry::Vector3 inertia;       // principal moments, about the axes of the part's frame, kg m²
  double heaviness = 1;            // the fraction of the part's mass on which gravity acts
  bool is_kinematic = false;       // forces do not move this part
};

// A model as a tree of rigid parts.
struct Articulation {
  std::vector<Part> parts;        // parents come before their children; the first part is the base
  std::vector<int> part_of_link;  // for each link of the model, the index of its part
  // Whether the base is fixed in the world: a joint attaches a link to the world, or the base is
  // kinematic and has child parts.
  bool is_fixed = false;
  double mass = 0;  // total mass of all parts, kg
};

// Links that are not the child of a joint belong to the base, which moves with the model's frame.
// If a movable joint attaches a link to the world, the link is a part of its own, and its parent is
// the base. The links between the three joints of a ball joint belong to the part of the ball
// joint's parent link.
Articulation MakeArticulation(const model::Model& model);

// The three joints of the model that form the ball joint above a part, from parent to child.
std::array<int, 3> JointsOfBall(const model::Model& model, const Part& part);

}  // namespace gsv::dynamics
