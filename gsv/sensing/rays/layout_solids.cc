#include "gsv/sensing/rays/layout_solids.h"

#include <algorithm>
#include <map>
#include <utility>

#include "gsv/sensing/rays/echo.h"

namespace gsv::sensing {
namespace {

using geometry::Pose;

void AddLink(const model::Link& link, const Pose& set_from_link, int body, SolidSet& solids) {
  for (std::size_t i = 0; i < link.collisions.size(); ++i) {
    const model::Collision& collision = link.collisions[i];
    solids.Add(collision.shape, set_from_link * collision.link_from_collision, body,
               static_cast<float>(ReflectanceOf(link, i)));
  }
}

// Returns the parts of a model that have solids.
std::vector<Part> MakeParts(const model::Model& model) {
  const std::vector<int> moving = world::MovingLinks(model);
  std::vector<Part> parts(1);
  for (int link = 0; link < static_cast<int>(model.links.size()); ++link) {
    if (std::binary_search(moving.begin(), moving.end(), link)) continue;
    AddLink(model.links[link], model.links[link].model_from_link, 0, parts[0].solids);
  }
  for (const int link : moving) {
    parts.emplace_back().link = link;
    AddLink(model.links[link], {}, 0, parts.back().solids);
  }
  std::erase_if(parts, [](const Part& part) { return part.solids.empty(); });
  for (Part& part : parts) {
    part.number = static_cast<int>(&part - parts.data());
    part.solids.Commit();
    part.ball = part.solids.ball();
  }
  return parts;
}

}  // namespace

LayoutSolids::LayoutSolids(std::shared_ptr<const world::Layout> of) : layout(std::move(of)) {
  // The index in `models` of each model's parts. The map is never iterated.
  std::map<const model::Model*, int> known;
  std::vector<BodyPart> endless;
  std::vector<std::pair<int, int>> bodies;  // moving bodies and the numbers of their models
  for (std::size_t i = 0; i < layout->bodies.size(); ++i) {
    const world::Body& body = layout->bodies[i];
    if (body.is_static()) {
      for (const model::Link& link : body.model->links) {
        AddLink(link, body.initial_pose * link.model_from_link, static_cast<int>(i), standing);
      }
      continue;
    }
    const auto [entry, is_new] =
        known.try_emplace(body.model.get(), static_cast<int>(models.size()));
    if (is_new) models.push_back(MakeParts(*body.model));
    bodies.emplace_back(static_cast<int>(i), entry->second);
  }
  standing.Commit();
  for (const auto& [body, model] : bodies) {
    first_part.resize(static_cast<std::size_t>(body) + 1,
                      static_cast<std::uint32_t>(moving.size()));
    for (const Part& part : models[model]) {
      follow_bodies = follow_bodies && part.link < 0 && !part.solids.endless();
      (part.solids.endless() ? endless : moving).push_back({&part, body});
    }
  }
  bounded = moving.size();
  first_part.resize(layout->bodies.size() + 1, static_cast<std::uint32_t>(bounded));
  moving.insert(moving.end(), endless.begin(), endless.end());
}

}  // namespace gsv::sensing
