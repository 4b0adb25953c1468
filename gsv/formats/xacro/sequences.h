// Implements Python's functions of lists: range, reversed, sorted, enumerate, zip, any, all.
#pragma once

#include <string>
#include <vector>

#include "gsv/base/error.h"
#include "gsv/formats/xacro/value.h"

namespace gsv::formats::xacro {

bool IsSequenceFunction(const std::string& name);
// Fails with kBadModel for invalid arguments, for a range() of more than 10,000 values, and for
// sorted() of more than 1,000 values. zip() ends after 10,000 values.
base::Result<Value> CallSequenceFunction(const std::string& name,
                                         const std::vector<Value>& arguments);

// Formats "{}", "{N}" and "{:.Df}" as str.format() does. Other fields are refused.
base::Result<Value> Formatted(const std::string& text, const std::vector<Value>& arguments);

}  // namespace gsv::formats::xacro
