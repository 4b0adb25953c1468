// The recipe of a proxy offer: how the importer's constraint becomes the one that the proxy's
// target is asked.
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

// True when it can be followed with these properties: each that it names is there, of a type that
// the constraint language has literals for. A dynamic property counts as what it promises.
bool IsRecipe(std::string_view recipe, const PropertyList& properties);

// Nothing when a property has no value, or one without a literal.
std::optional<std::string> FollowRecipe(std::string_view recipe, const PropertySource& properties,
                                        std::string_view constraint);

}  // namespace gsv::broker
