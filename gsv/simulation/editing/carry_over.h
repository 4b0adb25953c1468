// Computes the state of a world after bodies have been added or removed.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "gsv/world/snapshot.h"

namespace gsv::simulation {

// Returns a state for `layout`. Bodies that are also in `old_layout` get their state from
// `old_state`. The other bodies start at their initial poses. The states of devices are not
// changed; see CarryOverDevices().
world::State CarryOver(const world::Layout& old_layout, const world::State& old_state,
                       const world::Layout& layout);

// Returns an earlier snapshot with the bodies of `layout`. Bodies that it does not contain have their
// state in `now`, the state after the change.
world::Snapshot CarryOver(const world::Snapshot& earlier,
                          const std::shared_ptr<const world::Layout>& layout,
                          const world::State& now);

// Removes the contacts and the accelerations of these bodies from a snapshot.
void ForgetMotion(const std::vector<std::string>& bodies, world::Snapshot& snapshot);

// Puts a body at its initial pose, at rest.
void ResetToInitialPose(const world::Layout& layout, int body, world::State& state);

}  // namespace gsv::simulation
