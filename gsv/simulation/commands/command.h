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

// The types are in the same order as the alternatives of ArgumentValue: the number of a type is the
// index() of its values.
enum class ParameterType { kNumber, kInteger, kFlag, kText };
using ArgumentValue = std::variant<double, std::int64_t, bool, std::string>;

// Returns "number", "integer", "flag" or "text".
const char* ToString(ParameterType type);
// Returns the value as users write it, such as "-1.62" or "true". sba::NameValue contains values in
// this form.
std::string ToText(const ArgumentValue& value);

// A parameter of a command.
struct Parameter {
  std::string_view name;           // lower_case
  std::string_view former_name{};  // a former name that is still accepted; empty if there is none
  ParameterType type = ParameterType::kNumber;
  std::string_view unit{};     // such as "m/s²"; empty if there is none
  std::string_view summary{};  // the meaning of the parameter, as a noun phrase
  // The range of numbers and integers, including the bounds.
  double minimum = -std::numeric_limits<double>::infinity();
  double maximum = std::numeric_limits<double>::infinity();
  // The default value, or a text that says what the command does without the argument. A parameter
  // without either is required.
  std::optional<ArgumentValue> default_value{};
  std::string_view default_meaning{};

  bool is_required() const { return !default_value && default_meaning.empty(); }
};

// Arguments that are valid for the parameters of a command; only ReadArguments() creates them.
// Parameters with a default value always have an argument.
class Arguments {
 public:
  using Values = std::map<std::string, ArgumentValue, std::less<>>;

  // Returns the argument, or null if it is absent. `Value` is the parameter's alternative of
  // ArgumentValue.
  template <typename Value>
  const Value* Find(std::string_view name) const {
    const auto found = values_.find(name);
    return found == values_.end() ? nullptr : &std::get<Value>(found->second);
  }
  // Returns the argument, which must be present (GSV_CHECK).
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

// A command for a simulation, such as "pause".
struct Command {
  std::string_view name;     // lower_case
  std::string_view summary;  // an imperative that describes the command
  std::vector<Parameter> parameters{};
  // Applies the command. It may block, because a reset calls behaviours.
  base::Status (*apply)(Simulation& simulation, const Arguments& arguments) = nullptr;
  std::string_view former_name{};  // a former name that is still accepted; empty if there is none
};

}  // namespace gsv::simulation
