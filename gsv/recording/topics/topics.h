// The topics of a simulation that can be recorded.
#pragma once

#include <string>
#include <vector>

#include "gsv/simulation/simulation.h"

namespace gsv::recording {

// All topics that can be recorded now, by name. Robots and sensors that are added later have
// further ones.
std::vector<std::string> TopicsOf(const simulation::Simulation& simulation);

// Those of `patterns` (as in Selection) that match none of `topics`.
std::vector<std::string> UnmatchedPatterns(const std::vector<std::string>& topics,
                                           const std::vector<std::string>& patterns);

}  // namespace gsv::recording
