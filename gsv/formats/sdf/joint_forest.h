// Converts the joints of a file into a forest.
#pragma once

#include <cstddef>
#include <vector>

#include "gsv/model/model.h"

namespace gsv::formats {

// In SDFormat a link may be the child of several joints; in model::Model it may not. Joints keep
// their direction if possible. Otherwise parent and child are exchanged and the axis is reversed,
// so that the joint's position stays. Joints that would close a loop are removed and returned.
std::vector<model::Joint> MakeForest(std::size_t links, std::vector<model::Joint>& joints);

}  // namespace gsv::formats
