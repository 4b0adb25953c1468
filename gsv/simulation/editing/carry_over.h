// Computes the state of a world after bodies have been added or removed.
#pragma once

#include "gsv/world/state.h"

namespace gsv::simulation {

// Returns the state of `layout` that continues `old_state`. Bodies that are also in `old_layout`
// keep their state, and others start at their initial poses. Devices are unchanged, see
// CarryOverDevices().
world::State CarryOver(const world::Layout& old_layout, const world::State& old_state,
                       const world::Layout& layout);

// Puts a body at its initial pose, at rest.
void ResetToInitialPose(const world::Layout& layout, int body, world::State& state);

}  // namespace gsv::simulation
