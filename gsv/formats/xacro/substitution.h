// Substitutes ${expression} and $(command argument) in texts of attributes and properties.
//
// "$${" and "$$(" become the texts "${" and "$(".
#pragma once

#include <functional>
#include <string>

#include "gsv/base/error.h"
#include "gsv/formats/xacro/evaluation.h"

namespace gsv::formats::xacro {

// Returns the value of "$(command)". `command` includes the argument: "arg name", "find package".
using Command = std::function<base::Result<Value>(const std::string& command)>;

// Returns the value of the expression if the text is a single ${expression}; otherwise a text.
base::Result<Value> Substitute(const std::string& text, const EvaluationContext& context,
                               const Command& command);

}  // namespace gsv::formats::xacro
