// Whether two texts of elements say the same: numbers by value, true as 1.
#pragma once

#include <string_view>

namespace gsv::formats {

// Word by word: "0 0 0" is "0.0 0 -0", "true" is "1". Blanks around words do not count.
bool SaysTheSame(std::string_view a, std::string_view b);

}  // namespace gsv::formats
