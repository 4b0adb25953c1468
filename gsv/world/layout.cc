#include "gsv/world/layout.h"

#include <algorithm>

#include "gsv/base/check.h"
#include "gsv/base/sorting.h"

namespace gsv::world {
namespace {

// Whether the model is fixed to the world and has movable joints. Rigid-body dynamics moves such a
// model even if it has no collisions. Other models need collisions, because they would fall through
// the ground without them.
bool IsMechanism(const model::Model& model) {
  const auto is_to_world = [](const model::Joint& joint) { return joint.parent < 0; };
  const auto is_movable = [](const model::Joint& joint) {
    return joint.kind != model::JointKind::kFixed;
  };
  return std::any_of(model.joints.begin(), model.joints.end(), is_to_world) &&
         std::any_of(model.joints.begin(), model.joints.end(), is_movable);
}

}  // namespace

BodyKind KindOf(const model::Model& model, bool is_static, model::Movement movement) {
  if (model.script != nullptr) return BodyKind::kActor;
  if (is_static) return BodyKind::kStatic;
  const bool collides =
      std::any_of(model.links.begin(), model.links.end(),
                  [](const model::Link& link) { return !link.collisions.empty(); });
  // A driven body without collisions cannot stand on the ground, so it is planar.
  const bool is_planar = model.drive && (movement == model::Movement::kPlanar || !collides);
  if (is_planar) return BodyKind::kPlanarBase;
  return collides || IsMechanism(model) ? BodyKind::kRigidBody : BodyKind::kUnmoved;
}

BodyKind KindOf(const model::PlacedModel& placed) {
  return KindOf(*placed.model, placed.is_static || placed.model->is_static, placed.model->movement);
}

int Layout::Find(std::string_view name) const {
  const auto it =
      std::lower_bound(bodies.begin(), bodies.end(), name,
                       [](const Body& body, std::string_view n) { return body.name < n; });
  return it != bodies.end() && it->name == name ? static_cast<int>(it - bodies.begin()) : -1;
}

std::shared_ptr<const Layout> MakeLayout(
    std::uint32_t version, std::vector<Body> bodies,
    std::shared_ptr<const model::WorldDescription> description) {
  GSV_CHECK(description != nullptr);
  base::Sort(bodies, [](const Body& a, const Body& b) { return a.name < b.name; });
  auto layout = std::make_shared<Layout>();
  layout->version = version;
  layout->description = std::move(description);
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    GSV_CHECK(bodies[i].model != nullptr && !bodies[i].model->links.empty());
    GSV_CHECK(i == 0 || bodies[i - 1].name != bodies[i].name);
    bodies[i].first_joint = layout->joint_count;
    bodies[i].first_link = layout->link_count;
    layout->joint_count += static_cast<int>(bodies[i].model->joints.size());
    layout->link_count += static_cast<int>(bodies[i].model->links.size());
  }
  layout->bodies = std::move(bodies);
  return layout;
}

}  // namespace gsv::world
