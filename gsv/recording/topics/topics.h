// Lists the topics of a simulation that can be recorded.
#pragma once

#include <string>
#include <vector>

#include "gsv/simulation/simulation.h"

namespace gsv::recording {

// Returns all topics that can be recorded now, ordered by name. Robots and sensors that are added
// later add further topics.
std::vector<std::string> TopicsOf(const simulation::Simulation& simulation);

// Returns the patterns (see Selection) that match none of `topics`.
std::vector<std::string> UnmatchedPatterns(const std::vector<std::string>& topics,
                                           const std::vector<std::string>& patterns);

}  // namespace gsv::recording
