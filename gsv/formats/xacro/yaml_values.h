// Reads YAML files as values of expressions: xacro.load_yaml().
#pragma once

#include <filesystem>

#include "gsv/base/error.h"
#include "gsv/formats/xacro/value.h"

namespace gsv::formats::xacro {

// Converts plain scalars that are numbers and truth values. The tags !degrees, !radians,
// !meters, !millimeters, !inches and !foot convert to SI units, as those of xacro do.
// kBadModel, with file and line, for malformed YAML, more than `max_bytes`, or too deep nesting.
base::Result<Value> LoadYaml(const std::filesystem::path& file, std::size_t max_bytes);

}  // namespace gsv::formats::xacro
