// The recipe of a proxy offer. It converts the importer's constraint to a constraint for the
// proxy's target.
//
// A recipe is a text in which `$*` stands for the importer's constraint. `$(name)` stands for the
// value of the proxy's property as a literal, and `$$` for a dollar sign.
//
// Source  OMG Trading Object Service (formal/00-06-27), annex C.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "gsv/broker/language/property.h"

namespace gsv::broker {

// Whether every property in the recipe exists and has a type with literals in the constraint
// language. For a dynamic property, its declared type is checked.
bool IsRecipe(std::string_view recipe, const PropertyList& properties);

// Returns the constraint for the target. Returns nullopt if a property of the recipe has no value,
// or a value that cannot be written as a literal.
std::optional<std::string> FollowRecipe(std::string_view recipe, const PropertySource& properties,
                                        std::string_view constraint);

}  // namespace gsv::broker
