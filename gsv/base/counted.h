// Writes a number of items as text for a message.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace gsv::base {

// Returns a text such as "1 error" or "2 errors".
inline std::string Counted(std::uint64_t count, std::string_view noun) {
  return std::to_string(count) + " " + std::string(noun) + (count == 1 ? "" : "s");
}

}  // namespace gsv::base
