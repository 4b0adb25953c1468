#include "gsv/model/collision_names.h"

#include <algorithm>

namespace gsv::model {
namespace {

constexpr std::string_view kMerged = "_fixed_joint_lump__";

std::optional<CollisionIndex> InLink(const Model& model, int link, std::string_view name) {
  const auto& collisions = model.links[static_cast<std::size_t>(link)].collisions;
  for (std::size_t i = 0; i < collisions.size(); ++i) {
    if (collisions[i].name == name) return CollisionIndex{link, static_cast<int>(i)};
  }
  return std::nullopt;
}

std::optional<CollisionIndex> InAny(const Model& model, int link, std::string_view name) {
  if (auto found = InLink(model, link, name)) return found;
  for (std::size_t other = 0; other < model.links.size(); ++other) {
    if (auto found = InLink(model, static_cast<int>(other), name)) return found;
  }
  return std::nullopt;
}

// Finds a scoped name such as "robot::base::bumper". The link's name may itself be scoped, and the
// model's name may come first.
std::optional<CollisionIndex> Scoped(const Model& model, std::string_view name) {
  const std::size_t end = name.rfind("::");
  if (end == std::string_view::npos) return std::nullopt;
  const std::string_view collision = name.substr(end + 2);
  for (std::string_view link = name.substr(0, end);;) {
    for (std::size_t i = 0; i < model.links.size(); ++i) {
      if (model.links[i].name != link) continue;
      if (auto found = InLink(model, static_cast<int>(i), collision)) return found;
    }
    const std::size_t next = link.find("::");
    if (next == std::string_view::npos) return std::nullopt;
    link.remove_prefix(next + 2);
  }
}

std::string_view WithoutNumber(std::string_view name) {
  const std::size_t last = name.find_last_not_of("0123456789");
  const bool is_numbered =
      last != std::string_view::npos && last + 1 < name.size() && last > 0 && name[last] == '_';
  return is_numbered ? name.substr(0, last) : name;
}

std::string_view WithoutEnding(std::string_view name) {
  constexpr std::string_view kEnding = "_collision";
  return name.ends_with(kEnding) ? name.substr(0, name.size() - kEnding.size()) : name;
}

}  // namespace

std::vector<std::string> CollisionNamesOf(const SensorDescription& sensor) {
  std::vector<std::string> names;
  const std::string all = TextOr(sensor.parameters, kCollisionNames, "");
  for (std::size_t begin = 0; begin < all.size();) {
    const std::size_t end = std::min(all.find('\n', begin), all.size());
    std::string name = all.substr(begin, end - begin);
    if (!name.empty() && name != "__default__") names.push_back(std::move(name));
    begin = end + 1;
  }
  return names;
}

std::optional<CollisionIndex> FindCollision(const Model& model, int link, std::string_view name) {
  if (auto found = InAny(model, link, name)) return found;
  if (auto found = Scoped(model, name)) return found;
  const std::size_t merged = name.find(kMerged);
  if (merged == std::string_view::npos) return std::nullopt;
  const std::string_view inner = name.substr(merged + kMerged.size());
  for (const std::string_view each :
       {inner, WithoutNumber(inner), WithoutEnding(inner), WithoutEnding(WithoutNumber(inner))}) {
    if (auto found = InAny(model, link, each)) return found;
  }
  return std::nullopt;
}

}  // namespace gsv::model
