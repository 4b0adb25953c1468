// A model's links and joints as the one tree that URDF has.
//
// Frames  URDF has no frame for a joint: it is that of the child link. A joint moves to its child's frame
//         where that changes nothing. A joint that turns about an axis beside that frame gets an empty link
//         at its own frame, to which the child is fixed. So every link keeps its frame.
//         Readers that merge what is fixed (libsdformat) give the merged link the name of the empty one.
#pragma once

#include <string>
#include <vector>

#include "gsv/base/error.h"
#include "gsv/model/model.h"

namespace gsv::formats {

struct UrdfJoint {
  std::string name, type;  // "fixed", "revolute", "continuous", "prismatic", "floating"
  std::string parent, child;
  geometry::Pose parent_from_child;
  geometry::Vector3 axis{1, 0, 0};  // in the child's frame
  // the source of limits and dynamics; null for a joint that is added here
  const model::Joint* source = nullptr;
};

struct UrdfTree {
  std::vector<std::string> empty_links;  // links that the model does not have
  std::vector<UrdfJoint> joints;
};

// Warnings name what URDF cannot hold: screws, ball joints and links that nothing connects.
UrdfTree MakeUrdfTree(const model::Model& model, base::Problems& problems);

}  // namespace gsv::formats
