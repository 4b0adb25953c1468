// Reads the keys `faults` and `expect` of a scenario (docs/testing.md).
//
// Bounded  by kMaxFaults and kMaxFormulas, because YAML aliases can expand to many nodes.
#pragma once

#include <vector>

#include "gsv/scenario/expectation.h"
#include "gsv/scenario/fault.h"
#include "gsv/scenario/yaml_mapping.h"

namespace gsv::scenario {

inline constexpr std::size_t kMaxFaults = 1000;
inline constexpr int kMaxFormulas = 1000;    // maximum number in all expectations together
inline constexpr int kMaxFormulaDepth = 16;  // maximum nesting of operators

std::vector<Fault> ReadFaults(YamlMapping& scenario);

// Adds problems for expectations that cannot be tested: every run of `duration` (s) would violate
// them, or no run could violate them.
std::vector<Expectation> ReadExpectations(YamlMapping& scenario, double duration);

// Returns the node as equivalent YAML on one line. The caller must have limited its size and
// checked its keys.
std::string OneLineYaml(const YAML::Node& node);

}  // namespace gsv::scenario
