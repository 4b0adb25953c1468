// The names of bodies: which are allowed, and which are given to bodies that come without one.
#pragma once

#include <string>
#include <vector>

#include "gsv/base/error.h"
#include "gsv/simulation/simulation.h"
#include "gsv/world/layout.h"

namespace gsv::simulation {

base::Status CheckBodyName(const std::string& name);

// A name that no body of `layout` has: the model's, numbered from 2 on if taken.
std::string FreeName(const world::Layout& layout, const std::string& model);

// Names the robots that have no name, after their models. Fails when a name is not allowed, or is
// taken by a body of `layout` or by another of the robots.
base::Status NameRobots(const world::Layout& layout, std::vector<RobotSpecification>& robots);

}  // namespace gsv::simulation
