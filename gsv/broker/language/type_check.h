// Checks that the operands of an expression's operators have the types that the standard requires,
// as far as the service type declares them.
//
// Source  OMG Trading Object Service (formal/00-06-27), annex B, "operator restrictions".
#pragma once

#include <functional>
#include <optional>
#include <string_view>

#include "gsv/base/error.h"
#include "gsv/broker/language/expression.h"

namespace gsv::broker {

// The declared type of a property, or nullopt if the service type does not declare it. An offer may
// have such a property with any type.
using DeclaredTypes = std::function<std::optional<PropertyType>(std::string_view name)>;

// Errors  kInvalidArgument with the position of the operator whose operands can never have the
//         right types.
base::Status CheckConstraintTypes(const Expression& constraint, const DeclaredTypes& types);
base::Status CheckPreferenceTypes(const Preference& preference, const DeclaredTypes& types);

}  // namespace gsv::broker
