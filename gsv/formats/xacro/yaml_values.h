// Reads YAML files as values of expressions: xacro.load_yaml().
#pragma once

#include <filesystem>

#include "gsv/base/error.h"
#include "gsv/formats/xacro/value.h"

namespace gsv::formats::xacro {

// Reads a YAML file. Plain scalars that look like numbers or truth values are converted to them.
// The tags !degrees, !radians, !meters, !millimeters, !inches and !foot convert to SI units, as in
// xacro. Fails with kBadModel, file and line for malformed YAML, for more than `max_bytes`, and for
// too deep nesting.
base::Result<Value> LoadYaml(const std::filesystem::path& file, std::size_t max_bytes);

}  // namespace gsv::formats::xacro
