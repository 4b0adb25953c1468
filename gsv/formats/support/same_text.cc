#include "gsv/formats/support/same_text.h"

#include <cmath>
#include <cstdlib>
#include <optional>
#include <string>

namespace gsv::formats {
namespace {

constexpr double kRelativePrecision = 1e-9;

std::string_view TakeWord(std::string_view& text) {
  constexpr std::string_view kBlanks = " \t\r\n";
  const std::size_t first = text.find_first_not_of(kBlanks);
  if (first == std::string_view::npos) return text = {};
  const std::size_t end = text.find_first_of(kBlanks, first);
  const std::string_view word = text.substr(first, end - first);
  text = end == std::string_view::npos ? std::string_view() : text.substr(end);
  return word;
}

std::optional<double> NumberIn(std::string_view word) {
  if (word == "true" || word == "True") return 1;
  if (word == "false" || word == "False") return 0;
  const std::string text(word);
  char* end = nullptr;
  const double number = std::strtod(text.c_str(), &end);
  if (text.empty() || *end != '\0') return std::nullopt;
  return number;
}

bool IsSameWord(std::string_view a, std::string_view b) {
  if (a == b) return true;
  const auto x = NumberIn(a), y = NumberIn(b);
  return x && y &&
         (*x == *y ||
          std::abs(*x - *y) <= kRelativePrecision * std::max(std::abs(*x), std::abs(*y)));
}

}  // namespace

bool HasSameMeaning(std::string_view a, std::string_view b) {
  for (;;) {
    const std::string_view x = TakeWord(a), y = TakeWord(b);
    if (x.empty() || y.empty()) return x.empty() && y.empty();
    if (!IsSameWord(x, y)) return false;
  }
}

}  // namespace gsv::formats
