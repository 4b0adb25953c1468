// The report that `gsv run` prints at the end.
#pragma once

#include <string>
#include <vector>

#include "gsv/simulation/simulation.h"
#include "gsv/verdict/judge.h"

namespace gsv::app {

// Returns one line of JSON:
//   sim_time_s, wall_time_s, real_time_factor, steps, late_steps, state_hash, phase, failure,
//   robots:[{name, model, behaviour, agent, pose:{x_m,y_m,z_m,yaw_rad}, distance_m, collisions,
//   readings:{sonar: count, …}, health:{state, level, since_s, sentence}}], warnings:[…],
//   expectations:[{name, yaml, where, holds, step, time_s, detail, measured:[{what, lowest,
//   lowest_s, highest, highest_s, last}]}]
// A station also has `is_station: true`.
std::string JsonReport(simulation::Simulation& simulation, const std::vector<std::string>& warnings,
                       const std::vector<verdict::Finding>& findings);

// Returns the report as text.
std::string TextReport(simulation::Simulation& simulation,
                       const std::vector<verdict::Finding>& findings);

}  // namespace gsv::app
