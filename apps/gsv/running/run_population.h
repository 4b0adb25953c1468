// The robots of `gsv run`, and their behaviours.
#pragma once

#include "apps/gsv/running/run_options.h"

namespace gsv::app {

// Adds the scenario's robots and the avatars, and sets the behaviours of all, including the world's
// robots. Starts missing programs. Returns the actual scenario, which places the same robots at
// exactly the same poses when it is run again.
base::Result<scenario::Scenario> PopulateRun(Runtime& runtime, simulation::Simulation& simulation,
                                             const RunOptions& options, base::Problems& problems);

// The behaviour of a robot that is added at that time, with its program started if necessary; null
// if the robot has none.
base::Result<std::shared_ptr<simulation::BehaviourPort>> LateBehaviour(
    Runtime& runtime, const RunOptions& options, const scenario::RobotEntry& robot,
    base::SimTime from);

}  // namespace gsv::app
