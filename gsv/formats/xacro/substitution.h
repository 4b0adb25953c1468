// Texts with ${expression} and $(command argument) in them, as attributes and properties have.
//
// "$${" and "$$(" stand for "${" and "$(" themselves.
#pragma once

#include <functional>
#include <string>

#include "gsv/base/error.h"
#include "gsv/formats/xacro/evaluation.h"

namespace gsv::formats::xacro {

// Answers "$(command)": its argument included, as "arg name" or "find package".
using Command = std::function<base::Result<Value>(const std::string& command)>;

// The value of a text: that of its expression where it is one and nothing else, else a text.
base::Result<Value> Substitute(const std::string& text, const Surroundings& surroundings,
                               const Command& command);

}  // namespace gsv::formats::xacro
