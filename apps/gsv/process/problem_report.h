// Formats problems of files as lines for users. A problem that occurs in many places is printed
// once.
#pragma once

#include <string>
#include <vector>

#include "gsv/base/error.h"

namespace gsv::app {

// Returns the problems of that severity as "where: message". Problems with the same message are one
// sentence, with "(and in 41 more places)". The sentences are in the order in which their messages
// occur first.
std::vector<std::string> GroupedSentences(const base::Problems& problems,
                                          base::Problem::Severity severity);

// Returns the first `count` sentences. A further sentence has the number of the omitted sentences
// and the command that shows them.
std::vector<std::string> Shortened(std::vector<std::string> sentences, std::size_t count,
                                   const std::string& how_to_see_all);

}  // namespace gsv::app
