// Python's functions that make a list of others: range, reversed, sorted, enumerate, zip, and any
// and all.
#pragma once

#include <string>
#include <vector>

#include "gsv/base/error.h"
#include "gsv/formats/xacro/value.h"

namespace gsv::formats::xacro {

bool IsSequenceFunction(const std::string& name);
// kBadModel for arguments that do not fit, and for lists of more than 10,000 values.
base::Result<Value> CallSequenceFunction(const std::string& name,
                                         const std::vector<Value>& arguments);

// "{}", "{N}" and "{:.Df}" of str.format(): other fields are refused.
base::Result<Value> Formatted(const std::string& text, const std::vector<Value>& arguments);

}  // namespace gsv::formats::xacro
