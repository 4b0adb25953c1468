// Suggests names for misspelt ones.
#pragma once

#include <string>
#include <string_view>

#include "gsv/formats/support/support_table.h"

namespace gsv::formats {

// The number of letters to add, remove, change or swap with a neighbour to turn one into the other
// (the optimal string alignment distance); at most `limit` + 1.
int SpellingDistance(std::string_view a, std::string_view b, int limit);

// Whether `written` looks like a typing error of `known`: one letter of a short name, two of a
// longer one.
bool LooksLike(std::string_view written, std::string_view known);

// A sentence for an element or attribute that `parent` does not have: the intended name, or the
// element where it belongs; empty if neither is known. `parent_name` is the parent's name.
std::string AdviceForElement(std::string_view written, const ElementSupport& parent,
                             std::string_view parent_name);
std::string AdviceForAttribute(std::string_view written, const ElementSupport& parent);

}  // namespace gsv::formats
