// The filters of GetEntities and GetEntitiesStates.
//
// A filter is untrusted input. Regular expressions are restricted so that their evaluation is
// fast.
#pragma once

#include <memory>
#include <vector>

#include "gsv/base/error.h"
#include "gsv/messages/simulation_interfaces.h"
#include "gsv/world/snapshot.h"

namespace gsv::ros2 {

// Returns the category of a body, a constant of EntityCategory.
std::uint8_t CategoryOf(const world::Body& body);

// Returns the indices of the bodies that match, in ascending order. Fails with kInvalidArgument for
// a regular expression that is wrong, is longer than 256 characters, or has repetitions {n} or back
// references. Fails with kUnavailable for tags, and for bounds other than boxes and spheres.
base::Result<std::vector<int>> FilterEntities(
    const world::Snapshot& snapshot, const messages::simulation_interfaces::EntityFilters& filters);

}  // namespace gsv::ros2
