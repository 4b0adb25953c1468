// Compiles a regular expression once for all libraries of a program.
//
// <ignition/math/Helpers.hh> compiles the same expression at start for each source that includes
// it. This happens 80 times in libsdformat and libignition-math. Without this file, it takes two
// thirds of the time of a short run. This file defines the functions of libstdc++ that compile an
// expression. The libraries call these definitions if the program exports them (ENABLE_EXPORTS),
// and share what was compiled before.
//
// Bounded  expressions beyond the first kMaxSharedRegexes are compiled each time.
// Threads  any.
#pragma once

#include <cstddef>

namespace gsv::formats {

inline constexpr std::size_t kMaxSharedRegexes = 64;

// Returns the number of compiled expressions that are kept; 0 if the C++ library is not libstdc++.
std::size_t SharedRegexCount();

}  // namespace gsv::formats
