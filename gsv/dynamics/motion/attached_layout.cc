#include "gsv/dynamics/motion/attached_layout.h"

#include <algorithm>
#include <string>
#include <tuple>
#include <utility>

namespace gsv::dynamics {
namespace {

// Replaces the model of the body, which other bodies may share, by a copy. Returns the copy.
model::Model& OwnModel(world::Body& body) {
  auto model = std::make_shared<model::Model>(*body.model);
  body.model = model;
  return *model;
}

void AddCollisions(const model::Model& held, const std::vector<geometry::Pose>& held_from_links,
                   const geometry::Pose& link_from_held, model::Link& link) {
  for (std::size_t i = 0; i < held_from_links.size(); ++i) {
    for (model::Collision collision : held.links[i].collisions) {
      collision.link_from_collision =
          link_from_held * held_from_links[i] * collision.link_from_collision;
      link.collisions.push_back(std::move(collision));
    }
  }
}

}  // namespace

void AttachedLayout::Reset(std::shared_ptr<const world::Layout> layout) {
  layout_ = std::move(layout);
  held_.clear();
  has_changed_ = false;
}

bool AttachedLayout::IsHeld(int body) const {
  return std::any_of(held_.begin(), held_.end(),
                     [body](const Held& held) { return held.attachment.held_body == body; });
}

bool AttachedLayout::IsHolder(int body) const {
  return std::any_of(held_.begin(), held_.end(),
                     [body](const Held& held) { return held.attachment.holder_body == body; });
}

base::Status AttachedLayout::Check(const Attachment& attachment) const {
  const std::vector<world::Body>& bodies = layout_->bodies;
  const auto refuse = [](std::string message, std::string where = {}) {
    return base::Fail(base::ErrorCode::kInvalidArgument, std::move(message), std::move(where));
  };
  const auto exists = [&](int body) { return body >= 0 && body < static_cast<int>(bodies.size()); };
  if (!exists(attachment.holder_body) || !exists(attachment.held_body)) {
    return refuse("cannot attach body " + std::to_string(attachment.held_body) + " to body " +
                  std::to_string(attachment.holder_body) + ": the world has only " +
                  std::to_string(bodies.size()) + " bodies");
  }
  const world::Body& holder = bodies[attachment.holder_body];
  const world::Body& held = bodies[attachment.held_body];
  if (attachment.holder_link < 0 ||
      attachment.holder_link >= static_cast<int>(holder.model->links.size())) {
    return refuse("cannot attach: the holder has no link " + std::to_string(attachment.holder_link),
                  holder.name);
  }
  if (attachment.holder_body == attachment.held_body) {
    return refuse("cannot attach the body to itself", held.name);
  }
  if (holder.is_static()) return refuse("cannot attach: the holder is static", holder.name);
  if (IsHeld(attachment.holder_body)) {
    return refuse("cannot attach: the holder is itself attached to another body", holder.name);
  }
  if (!held.is_rigid()) {
    return refuse("cannot attach the body: it does not move by rigid-body dynamics", held.name);
  }
  if (IsHeld(attachment.held_body)) {
    return refuse("cannot attach the body: it is already attached; detach it first", held.name);
  }
  if (IsHolder(attachment.held_body)) {
    return refuse("cannot attach the body: it holds another body; detach that body first",
                  held.name);
  }
  return {};
}

base::Status AttachedLayout::Attach(const Attachment& attachment, const world::State& state) {
  if (auto ok = Check(attachment); !ok) return ok;
  const world::Body& body = layout_->bodies[attachment.held_body];
  Held held{
      attachment,
      world::LinkPoses(
          *body.model,
          std::span(state.joint_positions).subspan(body.first_joint, body.model->joints.size()))};
  const auto key = [](const Held& h) {
    const Attachment& a = h.attachment;
    return std::tuple(a.holder_body, a.holder_link, a.held_body);
  };
  const auto place =
      std::upper_bound(held_.begin(), held_.end(), held,
                       [&](const Held& a, const Held& b) { return key(a) < key(b); });
  held_.insert(place, std::move(held));
  has_changed_ = true;
  return {};
}

void AttachedLayout::Detach(int held_body) {
  const auto detached = std::erase_if(
      held_, [held_body](const Held& held) { return held.attachment.held_body == held_body; });
  if (detached > 0) has_changed_ = true;
}

std::shared_ptr<const world::Layout> AttachedLayout::TakeChanged() {
  if (!has_changed_) return nullptr;
  has_changed_ = false;
  return held_.empty() ? layout_ : Derive();
}

std::shared_ptr<const world::Layout> AttachedLayout::Derive() const {
  std::vector<world::Body> bodies = layout_->bodies;
  for (const auto& [attachment, held_from_links] : held_) {
    world::Body& held = bodies[attachment.held_body];
    AddCollisions(*held.model, held_from_links, attachment.link_from_held,
                  OwnModel(bodies[attachment.holder_body]).links[attachment.holder_link]);
    for (model::Link& link : OwnModel(held).links) link.collisions.clear();
    held.kind = world::BodyKind::kStatic;
  }
  return world::MakeLayout(layout_->version, std::move(bodies), layout_->description);
}

}  // namespace gsv::dynamics
