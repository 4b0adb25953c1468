// Computes the state of a world after bodies have been added or removed.
#pragma once

#include "gsv/world/state.h"

namespace gsv::simulation {

// Returns a state for `layout`. Bodies that are also in `old_layout` get their state from
// `old_state`. The other bodies start at their initial poses. The states of devices are not
// changed; see CarryOverDevices().
world::State CarryOver(const world::Layout& old_layout, const world::State& old_state,
                       const world::Layout& layout);

// Puts a body at its initial pose, at rest.
void ResetToInitialPose(const world::Layout& layout, int body, world::State& state);

}  // namespace gsv::simulation
