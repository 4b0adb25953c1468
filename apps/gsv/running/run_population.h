// The robots of `gsv run`, with their behaviours.
#pragma once

#include "apps/gsv/running/run_options.h"

namespace gsv::app {

// Adds the scenario's robots and the avatars, and gives behaviours to all, those that came with
// the world included. Programs that are missing are started. Gives the scenario as it came to be,
// which run again places the same robots at the same bits.
base::Result<scenario::Scenario> PopulateRun(Runtime& runtime, simulation::Simulation& simulation,
                                             const RunOptions& options, base::Problems& problems);

// The behaviour of a robot that comes at that time, its program started if it is missing; null
// where it has none.
base::Result<std::shared_ptr<simulation::BehaviourPort>> LateBehaviour(
    Runtime& runtime, const RunOptions& options, const scenario::RobotEntry& robot,
    base::SimTime from);

}  // namespace gsv::app
