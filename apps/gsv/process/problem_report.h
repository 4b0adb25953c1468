// Problems of files as lines for people: the same in many places is told once.
#pragma once

#include <string>
#include <vector>

#include "gsv/base/error.h"

namespace gsv::app {

// The problems of that severity in the order of their first place: "where: message", with
// "(and in 41 more places)" where others have the same message.
std::vector<std::string> GroupedSentences(const base::Problems& problems,
                                          base::Problem::Severity severity);

// The first `count` of the sentences, and one that counts the rest and says how to see them.
std::vector<std::string> Shortened(std::vector<std::string> sentences, std::size_t count,
                                   const std::string& how_to_see_all);

}  // namespace gsv::app
