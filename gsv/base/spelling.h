// Suggestions for misspelt names, such as "Did you mean office?".
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace gsv::base {

// The number of letters to add, remove, change or swap with a neighbour that turns one name into
// the other (the optimal string alignment distance); at most `limit` + 1. Names of more than 64
// bytes have the distance `limit` + 1.
int SpellingDistance(std::string_view a, std::string_view b, int limit);

// Whether `written` looks like a misspelling of `known`: they differ by one letter, or by two if
// both have eight letters or more. False for equal names, and for names of fewer than three
// letters.
bool LooksLike(std::string_view written, std::string_view known);

// The known name that `written` looks like: the one with the smallest distance, and the first in
// the list among equals. If there is none, the only known name that continues `written` ("comple":
// completion), or that `written` continues by one letter ("pss": ps). Otherwise empty.
std::string ClosestName(std::string_view written, const std::vector<std::string>& known);

// The end of an error message about an unknown name: ". Did you mean NAME?", or empty.
std::string DidYouMean(std::string_view written, const std::vector<std::string>& known);

}  // namespace gsv::base
