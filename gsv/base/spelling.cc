#include "gsv/base/spelling.h"

#include <algorithm>

namespace gsv::base {
namespace {

constexpr std::size_t kMaxNameLength = 64;
constexpr std::size_t kMinNameLength = 3;
// If the written name and the known name have at least this many letters, they may differ by two
// letters, else by one.
constexpr std::size_t kLongName = 8;

// Returns the only known name that begins with `written` ("comple": completion), or that is
// `written` without its last letter ("pss": ps). Returns an empty text if no name or several names
// match.
std::string OnlyContinuation(std::string_view written, const std::vector<std::string>& known) {
  std::string only;
  for (const std::string& name : known) {
    const bool is_begun = written.size() >= kMinNameLength && name.size() > written.size() &&
                          name.starts_with(written);
    const bool is_longer =
        name.size() >= 2 && written.size() == name.size() + 1 && written.starts_with(name);
    if (!is_begun && !is_longer) continue;
    if (!only.empty() && only != name) return {};
    only = name;
  }
  return only;
}

}  // namespace

int SpellingDistance(std::string_view a, std::string_view b, int limit) {
  const auto far = static_cast<std::size_t>(limit) + 1;
  if (a.size() > kMaxNameLength || b.size() > kMaxNameLength) return limit + 1;
  if (std::max(a.size(), b.size()) - std::min(a.size(), b.size()) > far) return limit + 1;
  std::vector<std::vector<int>> d(a.size() + 1, std::vector<int>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i) d[i][0] = static_cast<int>(i);
  for (std::size_t j = 0; j <= b.size(); ++j) d[0][j] = static_cast<int>(j);
  for (std::size_t i = 1; i <= a.size(); ++i) {
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const int change = a[i - 1] == b[j - 1] ? 0 : 1;
      d[i][j] = std::min({d[i - 1][j] + 1, d[i][j - 1] + 1, d[i - 1][j - 1] + change});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) {
        d[i][j] = std::min(d[i][j], d[i - 2][j - 2] + 1);
      }
    }
  }
  return std::min(d[a.size()][b.size()], limit + 1);
}

bool LooksLike(std::string_view written, std::string_view known) {
  const std::size_t shorter = std::min(written.size(), known.size());
  if (shorter < kMinNameLength || written == known) return false;
  // Two names of three letters may be two different words: "ksh" is not a misspelt "zsh".
  if (shorter == kMinNameLength && written.size() == known.size() &&
      !std::is_permutation(written.begin(), written.end(), known.begin())) {
    return false;
  }
  const int allowed = shorter >= kLongName ? 2 : 1;
  return SpellingDistance(written, known, allowed) <= allowed;
}

std::string ClosestName(std::string_view written, const std::vector<std::string>& known) {
  std::string closest;
  int least = 3;
  for (const std::string& name : known) {
    if (!LooksLike(written, name)) continue;
    const int distance = SpellingDistance(written, name, 2);
    if (distance >= least) continue;
    least = distance;
    closest = name;
  }
  return closest.empty() ? OnlyContinuation(written, known) : closest;
}

std::string DidYouMean(std::string_view written, const std::vector<std::string>& known) {
  const std::string closest = ClosestName(written, known);
  return closest.empty() ? "" : ". Did you mean " + closest + "?";
}

}  // namespace gsv::base
