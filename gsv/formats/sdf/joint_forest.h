// Converts the joints of a file into a forest: each link is the child of at most one joint, and no
// joint closes a loop.
#pragma once

#include <cstddef>
#include <vector>

#include "gsv/model/model.h"

namespace gsv::formats {

// model::Model requires a forest, SDFormat does not. Joints keep their direction if possible.
// Otherwise parent and child are exchanged and the axis is reversed, so that the joint's position
// keeps its value. Joints that would close a loop are removed from `joints` and returned.
std::vector<model::Joint> MakeForest(std::size_t links, std::vector<model::Joint>& joints);

}  // namespace gsv::formats
