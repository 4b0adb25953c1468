// Compares texts of elements by their meaning: numbers by value, and "true" as 1.
#pragma once

#include <string_view>

namespace gsv::formats {

// Compares word by word: "0 0 0" is "0.0 0 -0", "true" is "1". Blanks around words are ignored.
bool HasSameMeaning(std::string_view a, std::string_view b);

}  // namespace gsv::formats
