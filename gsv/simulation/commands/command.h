// A command on a simulation: a name, typed parameters, and the function that applies it.
//
// All front ends (IDL, HTTP, Foxglove services, command line, viewer) are generated from the table
// of commands, see command_table.h. Every command requires the permission to control.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "gsv/base/check.h"
#include "gsv/base/error.h"

namespace gsv::simulation {

class Simulation;

// In the order of ArgumentValue's alternatives.
enum class ParameterType { kNumber, kInteger, kFlag, kText };
using ArgumentValue = std::variant<double, std::int64_t, bool, std::string>;

// "number", "integer", "flag", "text".
const char* ToString(ParameterType type);
// The value as users write it, also in sba::NameValue: "-1.62", "true".
std::string ToText(const ArgumentValue& value);

struct Parameter {
  std::string_view name;           // lower_case
  std::string_view former_name{};  // still accepted in its place; empty: none
  ParameterType type = ParameterType::kNumber;
  std::string_view unit{};     // "m/s²"; empty: none
  std::string_view summary{};  // a noun phrase
  // The range of numbers and integers, bounds included.
  double minimum = -std::numeric_limits<double>::infinity();
  double maximum = std::numeric_limits<double>::infinity();
  // The default value, or in words the behaviour of the command without the argument. A parameter
  // with neither is required.
  std::optional<ArgumentValue> default_value{};
  std::string_view default_meaning{};

  bool is_required() const { return !default_value && default_meaning.empty(); }
};

// Arguments that are valid for the parameters of a command; only ReadArguments() makes them.
// Parameters with a default value always have an argument.
class Arguments {
 public:
  using Values = std::map<std::string, ArgumentValue, std::less<>>;

  // `Value` is the parameter's alternative of ArgumentValue. Null if the argument is absent.
  template <typename Value>
  const Value* Find(std::string_view name) const {
    const auto found = values_.find(name);
    return found == values_.end() ? nullptr : &std::get<Value>(found->second);
  }
  // The argument must be present (GSV_CHECK).
  template <typename Value>
  const Value& Get(std::string_view name) const {
    const Value* const value = Find<Value>(name);
    GSV_CHECK(value != nullptr);
    return *value;
  }
  const Values& values() const { return values_; }

 private:
  friend class ArgumentReader;
  explicit Arguments(Values values) : values_(std::move(values)) {}

  Values values_;
};

struct Command {
  std::string_view name;     // lower_case
  std::string_view summary;  // an imperative, as in docs/api.yaml
  std::vector<Parameter> parameters{};
  // May block: a reset calls behaviours.
  base::Status (*apply)(Simulation& simulation, const Arguments& arguments) = nullptr;
  std::string_view former_name{};  // still accepted in its place; empty: none
};

}  // namespace gsv::simulation
