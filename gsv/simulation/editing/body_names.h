// Checks the names of bodies, and chooses names for bodies without one.
#pragma once

#include <string>
#include <vector>

#include "gsv/base/error.h"
#include "gsv/simulation/simulation.h"
#include "gsv/world/layout.h"

namespace gsv::simulation {

// Returns an error if the name has more than 128 bytes or a "/". Callers treat an empty name.
base::Status CheckBodyName(const std::string& name);

// Returns a name that no body in `layout` has. This is the model's name if it is free. Otherwise, a
// number is appended, which starts at 2.
std::string FreeName(const world::Layout& layout, const std::string& model);

// Gives robots without a name the name of their model. Fails if a name is invalid, or if a body of
// `layout` or another of the robots has the same name.
base::Status NameRobots(const world::Layout& layout, std::vector<RobotSpecification>& robots);

}  // namespace gsv::simulation
