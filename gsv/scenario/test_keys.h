// The keys `faults` and `expect` of a scenario (docs/testing.md).
//
// Bounded  by kMaxFaults and kMaxFormulas: aliases may make a small file large.
#pragma once

#include <vector>

#include "gsv/scenario/expectation.h"
#include "gsv/scenario/fault.h"
#include "gsv/scenario/yaml_mapping.h"

namespace gsv::scenario {

inline constexpr std::size_t kMaxFaults = 1000;
inline constexpr int kMaxFormulas = 1000;
inline constexpr int kMaxFormulaDepth = 16;

std::vector<Fault> ReadFaults(YamlMapping& scenario);

// Complains of what no run of `duration` (s) can fulfil or violate.
std::vector<Expectation> ReadExpectations(YamlMapping& scenario, double duration);

// A node whose size is bounded and whose keys are known, as YAML on one line that is read as the
// same.
std::string OneLineYaml(const YAML::Node& node);

}  // namespace gsv::scenario
