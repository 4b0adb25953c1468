// Suggestions for misspelt names, such as "Did you mean office?".
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace gsv::base {

// The number of edits that turn one name into the other (the optimal string alignment distance),
// but at most `limit` + 1. One edit adds, removes or changes a letter, or swaps two adjacent
// letters. Names of more than 64 bytes have the distance `limit` + 1.
int SpellingDistance(std::string_view a, std::string_view b, int limit);

// Returns whether `written` looks like a misspelling of `known`: their distance is 1, or at most 2
// if both have eight letters or more. Two names of three letters must have the same letters.
// Returns false for equal names, and for names of fewer than three letters.
bool LooksLike(std::string_view written, std::string_view known);

// Returns the known name that `written` looks like. If `written` looks like several names, returns
// the name with the smallest distance, and of equal distances the first in the list. If `written`
// looks like no name, returns the only known name that begins with `written` ("comple":
// completion), or that is `written` without its last letter ("pss": ps). Otherwise returns an empty
// text.
std::string ClosestName(std::string_view written, const std::vector<std::string>& known);

// The end of an error message about an unknown name: ". Did you mean NAME?", or empty.
std::string DidYouMean(std::string_view written, const std::vector<std::string>& known);

}  // namespace gsv::base
