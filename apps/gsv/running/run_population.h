// The robots of `gsv run`, and their behaviours.
#pragma once

#include "apps/gsv/running/run_options.h"

namespace gsv::app {

// Adds the scenario's robots and avatars, and sets the behaviours of all robots, including the
// robots of the world file. Starts the programs of behaviours that the broker does not offer.
// Returns the actual scenario: a run of this scenario has the same robots at exactly the same
// poses.
base::Result<scenario::Scenario> PopulateRun(Runtime& runtime, simulation::Simulation& simulation,
                                             const RunOptions& options, base::Problems& problems);

// Returns the behaviour of a robot that is added at the time `from`, or null if the robot has none.
// Starts the behaviour's program if necessary.
base::Result<std::shared_ptr<simulation::BehaviourPort>> LateBehaviour(
    Runtime& runtime, const RunOptions& options, const scenario::RobotEntry& robot,
    base::SimTime from);

}  // namespace gsv::app
