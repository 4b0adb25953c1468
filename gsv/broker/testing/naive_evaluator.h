// A second evaluator, only for tests. It parses the text by recursive descent from the standard's
// productions and evaluates at the same time. It shares only Value with the real evaluator.
#pragma once

#include <string>

#include "gsv/broker/language/property.h"

namespace gsv::broker {

// `text` is a correct constraint.
bool NaivelyMatches(const std::string& text, const PropertyList& offer);

}  // namespace gsv::broker
