// Turns the joints of a file into a forest.
#pragma once

#include <cstddef>
#include <vector>

#include "gsv/model/model.h"

namespace gsv::formats {

// SDFormat lets a link be the child of several joints; model::Model does not. Joints keep their
// direction where they can; elsewhere parent and child change places and the axis its sign, which
// leaves the joint's position as it was. Joints that would close a loop are taken out; their names
// are returned.
std::vector<std::string> MakeForest(std::size_t links, std::vector<model::Joint>& joints);

}  // namespace gsv::formats
