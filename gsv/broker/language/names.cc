#include "gsv/broker/language/names.h"

#include <algorithm>
#include <array>

namespace gsv::broker {
namespace {

constexpr std::size_t kMaximumNameLength = 256;

bool IsScopedName(std::string_view name) {
  if (name.starts_with("::")) name.remove_prefix(2);
  for (;;) {
    const std::size_t end = name.find("::");
    if (!IsIdentifier(name.substr(0, end))) return false;
    if (end == std::string_view::npos) return true;
    name.remove_prefix(end + 2);
  }
}

bool IsRepositoryId(std::string_view name) {
  if (!name.starts_with("IDL:")) return false;
  name.remove_prefix(4);
  const std::size_t colon = name.rfind(':');
  if (colon == std::string_view::npos || colon == 0 || colon + 1 == name.size()) return false;
  const auto allowed = [](unsigned char c) {
    return IsLetter(c) || IsDigit(c) || c == '_' || c == '/' || c == '.' || c == '-';
  };
  const std::string_view version = name.substr(colon + 1);
  return std::all_of(name.begin(), name.begin() + static_cast<std::ptrdiff_t>(colon), allowed) &&
         std::all_of(version.begin(), version.end(),
                     [](unsigned char c) { return IsDigit(c) || c == '.'; });
}

}  // namespace

bool IsIdentifier(std::string_view name) {
  if (name.empty() || name.size() > kMaximumNameLength || !IsLetter(name.front())) return false;
  return std::all_of(name.begin(), name.end(),
                     [](unsigned char c) { return IsLetter(c) || IsDigit(c) || c == '_'; });
}

bool IsServiceTypeName(std::string_view name) {
  return name.size() <= kMaximumNameLength && (IsScopedName(name) || IsRepositoryId(name));
}

bool IsReservedWord(std::string_view name) {
  static constexpr std::array<std::string_view, 7> kWords = {"and",   "or",   "not",  "in",
                                                             "exist", "TRUE", "FALSE"};
  return std::find(kWords.begin(), kWords.end(), name) != kWords.end();
}

}  // namespace gsv::broker
