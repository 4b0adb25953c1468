// Formats problems of files as lines for users. A problem in many places is printed once.
#pragma once

#include <string>
#include <vector>

#include "gsv/base/error.h"

namespace gsv::app {

// The problems of that severity in the order of their first place: "where: message", with
// "(and in 41 more places)" if others have the same message.
std::vector<std::string> GroupedSentences(const base::Problems& problems,
                                          base::Problem::Severity severity);

// The first `count` sentences, and one that counts the rest and names the command that shows them.
std::vector<std::string> Shortened(std::vector<std::string> sentences, std::size_t count,
                                   const std::string& how_to_see_all);

}  // namespace gsv::app
