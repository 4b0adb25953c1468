// Which topics there are to record of a simulation.
#pragma once

#include <string>
#include <vector>

#include "gsv/simulation/simulation.h"

namespace gsv::recording {

// What a recording of everything would hold, by name, as the simulation stands now: a robot or a
// sensor that is added later brings further ones.
std::vector<std::string> TopicsOf(const simulation::Simulation& simulation);

// Those of `patterns` (as in Selection) that stand for none of `topics`.
std::vector<std::string> UnmatchedPatterns(const std::vector<std::string>& topics,
                                           const std::vector<std::string>& patterns);

}  // namespace gsv::recording
