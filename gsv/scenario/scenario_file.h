// Reads and writes scenarios as YAML (docs/formats/scenario.md). JSON is a subset of YAML.
//
// Units   metres, radians, seconds, Hz.
// Input   untrusted, of at most kMaxScenarioBytes.
// Errors  each problem names the file, the line and the column: room.yaml:7:5.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

#include "gsv/scenario/scenario.h"

namespace gsv::scenario {

inline constexpr std::size_t kMaxScenarioBytes = std::size_t{4} << 20;  // bytes

// Parses a scenario. Fails with kBadModel if the text is not YAML or not a scenario. Other mistakes
// are added to `problems` with the name `file`, and the wrong values are skipped.
base::Result<Scenario> ParseScenario(const std::string& text, const std::string& file,
                                     base::Problems& problems);

// Reads a scenario file. Names of worlds, models and folders that exist relative to the file's
// folder become absolute paths. Returns kNotFound if the file does not exist.
base::Result<Scenario> ReadScenario(const std::filesystem::path& file, base::Problems& problems);

// Whether `name` has the extension of a scenario file: ".yaml" or ".yml".
bool IsScenarioFileName(const std::string& name);

// Writes the scenario as YAML. ParseScenario() reads it back with identical numbers.
std::string ToYaml(const Scenario& scenario);

}  // namespace gsv::scenario
