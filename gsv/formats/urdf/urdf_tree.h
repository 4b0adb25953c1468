// Converts a model's links and joints to a single tree, as URDF requires.
//
// Frames  URDF has no separate frame for a joint: a joint is at the frame of its child link. If a
//         joint of the model has another frame, it is moved to the child's frame, provided that the
//         child's motion stays the same. The motion would change if the joint turns and its axis
//         does not pass through the child's origin. Then an empty link is added at the joint's
//         frame, and the child is fixed to it. So every link keeps its frame. libsdformat merges
//         the child with the empty link, and uses the empty link's name.
#pragma once

#include <string>
#include <vector>

#include "gsv/base/error.h"
#include "gsv/model/model.h"

namespace gsv::formats {

// A joint as URDF describes it.
struct UrdfJoint {
  std::string name, type;     // "fixed", "revolute", "continuous", "prismatic", "floating"
  std::string parent, child;  // names of links
  geometry::Pose parent_from_child;
  geometry::Vector3 axis{1, 0, 0};  // in the child's frame
  // the source of limits and dynamics; null for a joint that MakeUrdfTree() adds
  const model::Joint* source = nullptr;
};

// The joints of a model as one tree, and the links that were added for it.
struct UrdfTree {
  std::vector<std::string> empty_links;  // names of added links, which the model does not have
  std::vector<UrdfJoint> joints;
};

// Converts the model. Adds warnings for parts that URDF cannot represent: screws, ball joints and
// unconnected links.
UrdfTree MakeUrdfTree(const model::Model& model, base::Problems& problems);

}  // namespace gsv::formats
