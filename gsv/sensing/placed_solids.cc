#include "gsv/sensing/placed_solids.h"

#include <algorithm>
#include <utility>

#include "gsv/base/check.h"

namespace gsv::sensing {
namespace {

using geometry::Pose;
using geometry::Vector3;

// So many parts are placed in one go by a thread.
constexpr std::size_t kPartsAtOnce = 512;

// Whether the ray comes within the ball.
bool Passes(const Ray& ray, double length, const Vector3& centre, double radius) {
  const Vector3 to_centre = centre - ray.origin;
  const double along = std::clamp(Dot(to_centre, ray.direction), 0.0, length);
  const Vector3 gap = to_centre - along * ray.direction;
  return Dot(gap, gap) <= radius * radius;
}

}  // namespace

void PlacedSolids::Place(std::size_t index, const world::Snapshot& snapshot) {
  const auto& [part, body] = solids_->moving[index];
  Pose world_from_part = snapshot.state.bodies[body].world_from_model;
  if (part->link >= 0) {
    world_from_part = world_from_part * world::ModelFromLink(snapshot, body, part->link);
  }
  parts_[index] = {Inverse(world_from_part), part};
  if (index >= solids_->bounded) return;
  const Vector3 centre = world_from_part * part->ball.centre;
  const double radius = part->ball.radius;
  const Vector3 reach{radius, radius, radius};
  balls_[index] = {centre, radius, body};
  boxes_[index] = {centre - reach, centre + reach};
}

void PlacedSolids::MoveTo(std::shared_ptr<const LayoutSolids> solids,
                          const world::Snapshot& snapshot, base::ThreadTeam* team) {
  solids_ = std::move(solids);
  parts_.resize(solids_->moving.size());
  balls_.resize(solids_->bounded);
  boxes_.resize(solids_->bounded);
  const auto place = [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) Place(i, snapshot);
  };
  if (team != nullptr) {
    team->Share(parts_.size(), kPartsAtOnce, place);
  } else {
    place(0, parts_.size());
  }
  index_.Build(boxes_, /*often=*/true);
}

void PlacedSolids::CastAtPart(std::size_t index, const Ray& ray, Nearest& nearest) const {
  const auto& [part_from_world, part] = parts_[index];
  const int body = solids_->moving[index].body;
  const Ray local{part_from_world * ray.origin, part_from_world.orientation * ray.direction,
                  nearest.distance};
  Nearest found;
  found.distance = nearest.distance;
  part->solids.Cast(local, -1, found, body);
  if (found.body < 0) return;
  // Parts of one body are numbered above their primitives.
  const std::uint32_t primitive =
      (static_cast<std::uint32_t>(part->number) << 24) + found.primitive;
  nearest.Offer(found.distance, body, primitive,
                Inverse(part_from_world.orientation) * found.normal);
}

std::optional<Hit> PlacedSolids::Cast(const Ray& ray, int ignored_body) const {
  if (!(ray.max_distance >= 0) || !IsFinite(ray.origin) || !IsFinite(ray.direction)) return {};
  Nearest nearest;
  nearest.distance = ray.max_distance;
  solids_->standing.Cast(ray, ignored_body, nearest);
  for (std::size_t i = solids_->bounded; i < parts_.size(); ++i) {
    if (solids_->moving[i].body != ignored_body) CastAtPart(i, ray, nearest);
  }
  index_.Walk(ray, nearest.distance, [&](std::uint32_t i) {
    const PlacedBall& ball = balls_[i];
    if (ball.body == ignored_body) return;
    if (Passes(ray, nearest.distance, ball.centre, ball.radius)) CastAtPart(i, ray, nearest);
  });
  if (nearest.body < 0) return {};
  return Hit{nearest.distance, nearest.normal, nearest.body};
}

void PlacedSolids::Cast(std::span<const Ray> rays, int ignored_body,
                        std::span<std::optional<Hit>> hits) const {
  GSV_CHECK(rays.size() == hits.size());
  for (std::size_t i = 0; i < rays.size(); ++i) hits[i] = Cast(rays[i], ignored_body);
}

}  // namespace gsv::sensing
