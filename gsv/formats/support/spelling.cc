#include "gsv/formats/support/spelling.h"

#include <algorithm>
#include <set>
#include <vector>

#include "gsv/base/spelling.h"

namespace gsv::formats {
namespace {

constexpr int kLevelsToSearch = 3;
constexpr std::size_t kMinElementName = 4;

void CollectChildren(const ElementSupport& parent, std::set<std::string_view>& names) {
  for (const auto& [name, child] : parent.children) names.insert(name);
  if (parent.definition != nullptr) CollectChildren(*parent.definition, names);
  for (const ElementSupport* other : parent.borrowed) CollectChildren(*other, names);
}

void CollectAttributes(const ElementSupport& parent, std::set<std::string_view>& names) {
  for (const auto& [name, attribute] : parent.attributes) names.insert(name);
  if (parent.definition != nullptr) CollectAttributes(*parent.definition, names);
}

// Whether `written` is probably a misspelt `name`. Returns false if one of them is shorter than
// kMinElementName, because any two names as short as <x> and <a> look alike.
bool LooksLikeElement(std::string_view written, std::string_view name) {
  return std::min(written.size(), name.size()) >= kMinElementName && base::LooksLike(written, name);
}

std::string_view Likeliest(std::string_view written, const std::set<std::string_view>& names) {
  std::string_view best;
  int least = 3;
  for (const std::string_view name : names) {
    if (!LooksLikeElement(written, name)) continue;
    const int distance = base::SpellingDistance(written, name, 2);
    if (distance < least) least = distance, best = name;
  }
  return best;
}

// Returns the shortest path from `parent` down to an element with that name, such as "<axis>".
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
