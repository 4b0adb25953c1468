// Puts robots, with their behaviours, into a simulation.
#pragma once

#include "apps/gsv/run_options.h"

namespace gsv::app {

// Adds the scenario's robots and the avatars, and gives behaviours to all, those that came with
// the world included. A robot without a place gets the first free one on a spiral about the origin.
// Gives the scenario as it came to be, which run again places the same robots at the same bits.
base::Result<scenario::Scenario> Populate(Runtime& runtime, simulation::Simulation& simulation,
                                          const RunOptions& options, base::Problems& problems);

struct PlacedRobot {
  std::string name;
  scenario::Place place;
};

// Adds a robot at the first free place of a spiral about the origin.
base::Result<PlacedRobot> AddAtFreePlace(simulation::Simulation& simulation,
                                         simulation::RobotSpecification robot);

}  // namespace gsv::app
