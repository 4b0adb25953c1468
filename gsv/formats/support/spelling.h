// Suggests correct names for misspelt names.
#pragma once

#include <string>
#include <string_view>

#include "gsv/formats/support/support_table.h"

namespace gsv::formats {

// Returns a sentence for an element or attribute that `parent` does not have: the intended name, or
// the element to which it belongs. Empty if neither is known. `parent_name` is the parent's name.
std::string AdviceForElement(std::string_view written, const ElementSupport& parent,
                             std::string_view parent_name);
std::string AdviceForAttribute(std::string_view written, const ElementSupport& parent);

}  // namespace gsv::formats
