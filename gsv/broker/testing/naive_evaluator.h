// For tests: a second evaluator. It parses the text by recursive descent along the standard's
// productions, and evaluates at the same time. It shares only Value with the real evaluator.
#pragma once

#include <string>

#include "gsv/broker/language/property.h"

namespace gsv::broker {

// `text` must be a correct constraint.
bool NaivelyMatches(const std::string& text, const PropertyList& offer);

}  // namespace gsv::broker
