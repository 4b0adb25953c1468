// Scenarios as YAML files (docs/formats/scenario.md). JSON is YAML, too.
//
// Units   metres, radians, seconds, Hz.
// Input   hostile; bounded by kMaxScenarioBytes.
// Errors  each problem names the file, the line and the column: room.yaml:7:5.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

#include "gsv/scenario/scenario.h"

namespace gsv::scenario {

inline constexpr std::size_t kMaxScenarioBytes = std::size_t{4} << 20;  // bytes

// kBadModel when it is no YAML or no scenario at all; all else that is wrong is added to
// `problems`, and left out. `file` is what problems name.
base::Result<Scenario> ParseScenario(const std::string& text, const std::string& file,
                                     base::Problems& problems);

// The same from a file. Names of a world, models and folders of models that are there, seen from
// the file's folder, become whole paths. kNotFound when there is no such file.
base::Result<Scenario> ReadScenario(const std::filesystem::path& file, base::Problems& problems);

// Whether `name`, by its ending, is a scenario's file: ".yaml" or ".yml".
bool IsScenarioFileName(const std::string& name);

// What ParseScenario() reads back as it is, number by number.
std::string ToYaml(const Scenario& scenario);

}  // namespace gsv::scenario
