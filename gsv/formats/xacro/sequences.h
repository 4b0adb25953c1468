// Implements Python's functions of lists: range, reversed, sorted, enumerate, zip, any, all.
#pragma once

#include <string>
#include <vector>

#include "gsv/base/error.h"
#include "gsv/formats/xacro/value.h"

namespace gsv::formats::xacro {

bool IsSequenceFunction(const std::string& name);
// Fails with kBadModel for invalid arguments, and for lists of more than 10,000 values.
base::Result<Value> CallSequenceFunction(const std::string& name,
                                         const std::vector<Value>& arguments);

// Formats "{}", "{N}" and "{:.Df}" as str.format() does. Other fields are refused.
base::Result<Value> Formatted(const std::string& text, const std::vector<Value>& arguments);

}  // namespace gsv::formats::xacro
