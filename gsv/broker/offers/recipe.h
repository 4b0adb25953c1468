// The recipe of a proxy offer, which makes the constraint for the proxy's target from the
// importer's constraint.
//
// A recipe is text in which `$*` stands for the importer's constraint, `$(name)` for the value of
// the proxy's property as a literal, and `$$` for a dollar sign.
//
// Source  OMG Trading Object Service (formal/00-06-27), annex C.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "gsv/broker/language/property.h"

namespace gsv::broker {

// True if every property in the recipe exists and has a type with literals in the constraint
// language. For a dynamic property the declared type counts.
bool IsRecipe(std::string_view recipe, const PropertyList& properties);

// The constraint for the target; nothing if a property has no value, or a value without a literal.
std::optional<std::string> FollowRecipe(std::string_view recipe, const PropertySource& properties,
                                        std::string_view constraint);

}  // namespace gsv::broker
