// Converts a model's links and joints to a single tree, as URDF requires.
//
// Frames  URDF has no separate frame for a joint: it is the frame of the child link. A joint moves
//         to its child's frame if that changes nothing. If a joint turns about an axis that does
//         not pass through that frame, an empty link is added at the joint's frame, and the child
//         is fixed to it. So every link keeps its frame. libsdformat merges both under its name.
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
  std::vector<std::string> empty_links;  // names of added links, which the model does not have
  std::vector<UrdfJoint> joints;
};

// Warnings name the parts that URDF cannot represent: screws, ball joints and unconnected links.
UrdfTree MakeUrdfTree(const model::Model& model, base::Problems& problems);

}  // namespace gsv::formats
