// Evaluates xacro's expressions in a sandbox: no file, no clock, no environment, bounded results.
//
// Errors  kBadModel with the reason (an undefined name, a type that does not fit, a division by
//         zero, an unsupported function). The caller adds the place.
// Unlike in Python, integers beyond 64 bits are errors.
#pragma once

#include <functional>
#include <string>

#include "gsv/base/error.h"
#include "gsv/formats/xacro/value.h"

namespace gsv::formats::xacro {

// The functions with which an expression accesses properties, arguments and YAML files.
struct EvaluationContext {
  // Returns a property's value, or nullopt if there is no such property.
  std::function<base::Result<std::optional<Value>>(const std::string& name)> property;
  // These functions return the content of a YAML file, and the value of an argument. Each function
  // may be empty.
  std::function<base::Result<Value>(const std::string& file)> load_yaml;
  std::function<base::Result<Value>(const std::string& name)> argument;
  // Receives the texts of xacro.message(), xacro.warning() and xacro.error(); may be empty.
  std::function<void(const std::string& text)> report;
};

base::Result<Value> Evaluate(const std::string& expression, const EvaluationContext& context);

}  // namespace gsv::formats::xacro
