// A second evaluator, for tests alone: it reads the text by recursive descent from the standard's
// productions and evaluates as it goes, sharing nothing with the real one but Value.
#pragma once

#include <string>

#include "gsv/broker/language/property.h"

namespace gsv::broker {

// `text` is a correct constraint.
bool NaivelyMatches(const std::string& text, const PropertyList& offer);

}  // namespace gsv::broker
