#include "gsv/formats/support/spelling.h"

#include <algorithm>
#include <set>
#include <vector>

namespace gsv::formats {
namespace {

constexpr int kLevelsToSearch = 3;
constexpr std::size_t kLongestName = 64;

void CollectChildren(const ElementSupport& parent, std::set<std::string_view>& names) {
  for (const auto& [name, child] : parent.children) names.insert(name);
  if (parent.definition != nullptr) CollectChildren(*parent.definition, names);
  for (const ElementSupport* other : parent.borrowed) CollectChildren(*other, names);
}

void CollectAttributes(const ElementSupport& parent, std::set<std::string_view>& names) {
  for (const auto& [name, attribute] : parent.attributes) names.insert(name);
  if (parent.definition != nullptr) CollectAttributes(*parent.definition, names);
}

std::string_view Likeliest(std::string_view written, const std::set<std::string_view>& names) {
  std::string_view best;
  int least = 3;
  for (const std::string_view name : names) {
    if (!LooksLike(written, name)) continue;
    const int distance = SpellingDistance(written, name, 2);
    if (distance < least) least = distance, best = name;
  }
  return best;
}

// The shortest path from `parent` down to an element of that name, such as "<axis>".
std::string WayDown(std::string_view written, const ElementSupport& parent, int levels) {
  if (levels == 0) return {};
  std::set<std::string_view> names;
  CollectChildren(parent, names);
  std::string best;
  for (const std::string_view name : names) {
    const ElementSupport& child = *parent.Child(name);
    if (child.Child(written) == nullptr) continue;
    return "<" + std::string(name) + ">";
  }
  for (const std::string_view name : names) {
    const std::string below = WayDown(written, *parent.Child(name), levels - 1);
    if (below.empty()) continue;
    const std::string way = "<" + std::string(name) + ">" + below;
    if (best.empty() || way.size() < best.size()) best = way;
  }
  return best;
}

}  // namespace

int SpellingDistance(std::string_view a, std::string_view b, int limit) {
  const auto far = static_cast<std::size_t>(limit) + 1;
  if (a.size() > kLongestName || b.size() > kLongestName) return limit + 1;
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
  if (written.size() < 4 || known.size() < 4) return false;
  const int allowed = std::min(written.size(), known.size()) >= 8 ? 2 : 1;
  return written != known && SpellingDistance(written, known, allowed) <= allowed;
}

std::string AdviceForElement(std::string_view written, const ElementSupport& parent,
                             std::string_view parent_name) {
  if (parent.Attribute(written) != nullptr) {
    return "It is an attribute: <" + std::string(parent_name) + " " + std::string(written) +
           "=\"…\">.";
  }
  std::set<std::string_view> names;
  CollectChildren(parent, names);
  if (const std::string_view meant = Likeliest(written, names); !meant.empty()) {
    return "Did you mean <" + std::string(meant) + ">?";
  }
  const std::string way = WayDown(written, parent, kLevelsToSearch);
  return way.empty() ? std::string() : "It belongs in " + way + ".";
}

std::string AdviceForAttribute(std::string_view written, const ElementSupport& parent) {
  if (parent.Child(written) != nullptr) {
    return "It is an element: <" + std::string(written) + ">.";
  }
  std::set<std::string_view> names;
  CollectAttributes(parent, names);
  const std::string_view meant = Likeliest(written, names);
  return meant.empty() ? std::string() : "Did you mean \"" + std::string(meant) + "\"?";
}

}  // namespace gsv::formats
