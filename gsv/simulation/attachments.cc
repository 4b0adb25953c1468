#include "gsv/simulation/attachments.h"

#include <span>
#include <utility>

#include "gsv/base/check.h"

namespace gsv::simulation {
namespace {

using geometry::Pose;

// The collision shapes of a body, as parts of a link that holds it.
void AddCollisions(const world::Body& held, const world::State& state, const Pose& link_from_held,
                   model::Link& link) {
  const std::vector<Pose> held_from_link = world::LinkPoses(
      *held.model,
      std::span(state.joint_positions)
          .subspan(static_cast<std::size_t>(held.first_joint), held.model->joints.size()));
  for (std::size_t i = 0; i < held_from_link.size(); ++i) {
    for (model::Collision collision : held.model->links[i].collisions) {
      collision.link_from_collision =
          link_from_held * held_from_link[i] * collision.link_from_collision;
      link.collisions.push_back(std::move(collision));
    }
  }
}

}  // namespace

base::Status Attachments::SetLayout(const std::shared_ptr<const world::Layout>& layout,
                                    const world::State& state, dynamics::Engine& engine) {
  holds_ = HoldsIn(state);
  return engine.SetLayout(WithHeld(layout, holds_, state));
}

void Attachments::Follow(const std::shared_ptr<const world::Layout>& layout,
                         const world::State& state, dynamics::Engine& engine) {
  if (state.devices == nullptr && holds_.empty()) return;
  if (HoldsIn(state) == holds_) return;
  GSV_CHECK(SetLayout(layout, state, engine));  // it took the same bodies before
}

std::vector<Attachments::Hold> Attachments::HoldsIn(const world::State& state) {
  std::vector<Hold> holds;
  if (state.devices == nullptr) return holds;
  for (const world::DeviceStatePtr& device : *state.devices) {
    const world::Grasp* const grasp = device->grasp();
    if (grasp != nullptr) holds.push_back({device->robot(), device->mount().link, *grasp});
  }
  return holds;
}

std::shared_ptr<const world::Layout> Attachments::WithHeld(
    const std::shared_ptr<const world::Layout>& layout, const std::vector<Hold>& holds,
    const world::State& state) {
  if (holds.empty()) return layout;
  std::vector<world::Body> bodies = layout->bodies;
  const auto change = [](world::Body& body) {
    auto model = std::make_shared<model::Model>(*body.model);
    body.model = model;
    return model;
  };
  for (const Hold& hold : holds) {
    world::Body& robot = bodies[static_cast<std::size_t>(layout->Find(hold.robot))];
    world::Body& held = bodies[static_cast<std::size_t>(layout->Find(hold.grasp.held))];
    AddCollisions(held, state, hold.grasp.link_from_held,
                  change(robot)->links[static_cast<std::size_t>(hold.link)]);
    for (model::Link& link : change(held)->links) link.collisions.clear();
    held.kind = world::BodyKind::kStatic;
  }
  return world::MakeLayout(layout->version, std::move(bodies), layout->description);
}

}  // namespace gsv::simulation
