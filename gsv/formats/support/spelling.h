// Names that somebody may have meant.
#pragma once

#include <string>
#include <string_view>

#include "gsv/formats/support/support_table.h"

namespace gsv::formats {

// The number of letters to add, take away, change or swap with a neighbour to make one of the
// other (the optimal string alignment distance); at most `limit` + 1.
int SpellingDistance(std::string_view a, std::string_view b, int limit);

// Whether `written` looks like a slip of the pen for `known`: one letter of a short name, two of a
// longer one.
bool LooksLike(std::string_view written, std::string_view known);

// A sentence for an element or attribute that `parent` does not have: what it may have been meant
// to be, or where else it belongs; empty if neither is known. `parent_name` is the parent's name.
std::string AdviceForElement(std::string_view written, const ElementSupport& parent,
                             std::string_view parent_name);
std::string AdviceForAttribute(std::string_view written, const ElementSupport& parent);

}  // namespace gsv::formats
