#include "gsv/dynamics/rigid/contact_finder.h"

#include <algorithm>

namespace gsv::dynamics {
namespace {

using geometry::Vector3;

// Contacts begin at this distance (m), plus the distances that the two bodies may move in the
// substep.
constexpr double kContactMargin = 1e-3;
// A body carries another from below if the normal is within 45° of the vertical (its cosine).
constexpr double kCarries = 0.70710678118654757;

Vector3 Least(const Vector3& a, const Vector3& b) {
  return {std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z)};
}
Vector3 Greatest(const Vector3& a, const Vector3& b) {
  return {std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z)};
}

bool Overlap(const Vector3& low_a, const Vector3& high_a, const Vector3& low_b,
             const Vector3& high_b, double margin) {
  return low_a.x <= high_b.x + margin && low_b.x <= high_a.x + margin &&
         low_a.y <= high_b.y + margin && low_b.y <= high_a.y + margin &&
         low_a.z <= high_b.z + margin && low_b.z <= high_a.z + margin;
}

bool IsAbove(const PlacedPiece& piece, const PlacedPiece& plane, double margin) {
  const Vector3 normal = plane.rotation * plane.piece->normal;
  const Vector3 lowest{normal.x > 0 ? piece.low.x : piece.high.x,
                       normal.y > 0 ? piece.low.y : piece.high.y,
                       normal.z > 0 ? piece.low.z : piece.high.z};
  return Dot(normal, lowest - plane.position) > margin;
}

}  // namespace

void ContactFinder::SetScene(const RigidScene& scene,
                             std::span<const std::unique_ptr<MovingBody>> bodies) {
  scene_ = &scene;
  bodies_ = bodies;
  colliders_.clear();
  groups_.clear();
  collider_of_piece_.clear();
  static_poses_.clear();
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    Group& group = groups_.emplace_back();
    group.moving = static_cast<int>(b);
    group.first_collider = static_cast<int>(colliders_.size());
    group.first_piece = static_cast<int>(collider_of_piece_.size());
    const auto& solids = scene.bodies()[b].solids;
    for (std::size_t part = 0; part < solids.size(); ++part) {
      collider_of_piece_.insert(collider_of_piece_.end(), solids[part].pieces.size(),
                                static_cast<int>(colliders_.size()));
      colliders_.push_back({&solids[part],
                            group.moving,
                            static_cast<int>(part),
                            solids[part].bounces(),
                            {},
                            {},
                            {}});
    }
    group.collider_count = static_cast<int>(solids.size());
    group.piece_count = static_cast<int>(collider_of_piece_.size()) - group.first_piece;
  }
  for (const Solid& solid : scene.standing())
    colliders_.push_back({&solid, -1, 0, false, {}, {}, {}});
  static_colliders_ = colliders_.size();
  rigid_pieces_ = collider_of_piece_.size();
}

void ContactFinder::Start(const world::State& state) {
  colliders_.resize(static_colliders_);
  groups_.resize(bodies_.size());
  collider_of_piece_.resize(rigid_pieces_);
  const auto& standing = scene_->standing();
  bool is_same = static_poses_.size() == standing.size();
  for (std::size_t i = 0; is_same && i < standing.size(); ++i) {
    is_same = static_poses_[i] ==
              state.bodies[static_cast<std::size_t>(standing[i].body)].world_from_model;
  }
  if (!is_same || standing.empty()) PlaceStatic(state);
  pieces_.resize(rigid_pieces_);
}

void ContactFinder::PlaceStatic(const world::State& state) {
  static_poses_.clear();
  statics_.clear();
  planes_.clear();
  const auto& standing = scene_->standing();
  for (std::size_t i = 0; i < standing.size(); ++i) {
    const geometry::Pose& pose =
        state.bodies[static_cast<std::size_t>(standing[i].body)].world_from_model;
    static_poses_.push_back(pose);
    const Matrix3 rotation = MatrixOf(pose.orientation);
    const int collider = static_cast<int>(static_colliders_ - standing.size() + i);
    for (const Piece& piece : standing[i].pieces) {
      auto& list = piece.kind == Piece::Kind::kPlane ? planes_ : statics_;
      list.push_back({dynamics::Place(piece, pose.position, rotation), collider});
    }
  }
  std::vector<BoxBvh::Box> boxes;
  for (const StaticPiece& piece : statics_) boxes.push_back({piece.placed.low, piece.placed.high});
  static_bvh_.Build(boxes);
}

int ContactFinder::AddPlanar(const Solid& solid) {
  Group& group = groups_.emplace_back();
  group.first_collider = static_cast<int>(colliders_.size());
  group.collider_count = 1;
  group.first_piece = static_cast<int>(collider_of_piece_.size());
  group.piece_count = static_cast<int>(solid.pieces.size());
  collider_of_piece_.insert(collider_of_piece_.end(), solid.pieces.size(), group.first_collider);
  colliders_.push_back({&solid, -1, 0, false, {}, {}, {}});
  pieces_.resize(collider_of_piece_.size());
  return static_cast<int>(groups_.size() - bodies_.size()) - 1;
}

void ContactFinder::MovePlanar(int index, const geometry::Pose& pose, const Vector3& velocity,
                               const Vector3& angular_velocity) {
  Group& group = groups_[bodies_.size() + static_cast<std::size_t>(index)];
  Collider& collider = colliders_[static_cast<std::size_t>(group.first_collider)];
  collider.position = pose.position;
  collider.velocity = velocity;
  collider.angular_velocity = angular_velocity;
  const Matrix3 rotation = MatrixOf(pose.orientation);
  for (int i = 0; i < group.piece_count; ++i) {
    pieces_[static_cast<std::size_t>(group.first_piece + i)] = dynamics::Place(
        collider.solid->pieces[static_cast<std::size_t>(i)], pose.position, rotation);
  }
  PlaceGroup(group);
}

void ContactFinder::PlaceGroup(Group& group) {
  if (group.piece_count == 0) return;
  const auto first = static_cast<std::size_t>(group.first_piece);
  group.low = pieces_[first].low;
  group.high = pieces_[first].high;
  for (std::size_t i = 1; i < static_cast<std::size_t>(group.piece_count); ++i) {
    group.low = Least(group.low, pieces_[first + i].low);
    group.high = Greatest(group.high, pieces_[first + i].high);
  }
}

void ContactFinder::PlaceBodies() {
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    Group& group = groups_[b];
    const LinkTree& tree = bodies_[b]->tree();
    auto piece = static_cast<std::size_t>(group.first_piece);
    const auto& solids = scene_->bodies()[b].solids;
    for (std::size_t part = 0; part < solids.size(); ++part) {
      const int at = static_cast<int>(part);
      for (const Piece& each : solids[part].pieces) {
        pieces_[piece++] = dynamics::Place(each, tree.position(at), tree.rotation(at));
      }
    }
    PlaceGroup(group);
  }
}

void ContactFinder::Bounds(int moving, Vector3& low, Vector3& high) const {
  const Group& group = groups_[static_cast<std::size_t>(moving)];
  low = group.low;
  high = group.high;
  if (group.piece_count == 0) {
    low = high = bodies_[static_cast<std::size_t>(moving)]->tree().position(0);
  }
}

Vector3 ContactFinder::VelocityOf(const Collider& collider, const Vector3& point) const {
  if (collider.moving >= 0) {
    return bodies_[static_cast<std::size_t>(collider.moving)]->VelocityOf(collider.part, point);
  }
  return collider.velocity + Cross(collider.angular_velocity, point - collider.position);
}

Vector3 ContactFinder::PointOnFirst(const Contact& contact) const {
  const Collider& first = collider(contact.first);
  const LinkTree& tree = bodies_[static_cast<std::size_t>(first.moving)]->tree();
  return TransposeTimes(tree.rotation(first.part), contact.on_first() - tree.position(first.part));
}

// Whether one body is a base without wheels, and the other body carries the base. The drive moves a
// base without wheels directly, so there must be no friction between the two bodies.
bool ContactFinder::GlidesOn(const Collider& first, const Collider& second,
                             const Vector3& normal) const {
  const auto is_held = [&](const Collider& collider) {
    return collider.moving >= 0 && bodies_[static_cast<std::size_t>(collider.moving)]->is_held();
  };
  return (is_held(first) && normal.z > kCarries) || (is_held(second) && normal.z < -kCarries);
}

// Returns the collider as a wheel that slips on this ground, or nullopt if it does not slip.
std::optional<SlippingContact> ContactFinder::SlippingOf(const Collider& collider,
                                                         const model::Surface& ground,
                                                         const Vector3& normal) const {
  const auto& wheel = collider.solid->wheel;
  if (!wheel || collider.moving < 0) return std::nullopt;
  if (wheel->wheel.slip.is_none() && ground.wheel_slip.is_none()) return std::nullopt;
  const MovingBody& body = *bodies_[static_cast<std::size_t>(collider.moving)];
  const double rate = body.WheelRate(collider.part);
  const Vector3 axle = body.tree().rotation(collider.part) * wheel->axle;
  return SlippingContact{Cross(axle, normal), rate * wheel->PerRateAlong(ground.wheel_slip),
                         rate * wheel->PerRateAcross(ground.wheel_slip)};
}

// Contact::slip refers to the sum of the friction forces at all contact points of two solids. Each
// point has only a part of this force, so its softness is multiplied by the number of points.
void ContactFinder::SetSoftness(double substep) {
  slipping_.clear();
  const auto slips = [](const Contact& contact) {
    return contact.slip[0] != 0 || contact.slip[1] != 0;
  };
  for (const Contact& contact : contacts_) {
    if (slips(contact)) slipping_.emplace_back(contact.first, contact.second);
  }
  if (slipping_.empty() || !(substep > 0)) return;
  std::sort(slipping_.begin(), slipping_.end());
  for (Contact& contact : contacts_) {
    if (!slips(contact)) continue;
    const auto [begin, end] = std::equal_range(slipping_.begin(), slipping_.end(),
                                               std::pair(contact.first, contact.second));
    const auto points = static_cast<double>(end - begin);
    for (std::size_t i = 0; i < 2; ++i) contact.softness[i] = points * contact.slip[i] / substep;
  }
}

void ContactFinder::AddPair(int first, const PlacedPiece& first_piece, int second,
                            const PlacedPiece& second_piece, double margin) {
  if (!model::Meet(first_piece.piece->surface.filter, second_piece.piece->surface.filter)) return;
  points_.clear();
  if (!AddTouchPoints(first_piece, second_piece, margin, points_)) {
    bullet_.AddTouchPoints(first_piece, second_piece, margin, points_);
  }
  const bool bounces = collider(first).bounces || collider(second).bounces;
  for (const TouchPoint& point : points_) {
    if (bounces && point.distance > 0) continue;
    Contact& contact = contacts_.emplace_back();
    contact.first = first;
    contact.second = second;
    contact.point = point;
    auto wheel = SlippingOf(collider(first), second_piece.piece->surface, point.normal);
    if (!wheel) wheel = SlippingOf(collider(second), first_piece.piece->surface, point.normal);
    SetSurfaces(first_piece, second_piece, wheel ? &*wheel : nullptr, contact);
    if (GlidesOn(collider(first), collider(second), point.normal)) contact.friction = 0;
  }
}

void ContactFinder::AddGroupPair(const Group& a, const Group& b) {
  const double margin = kContactMargin + a.reach + b.reach;
  for (int i = a.first_piece; i < a.first_piece + a.piece_count; ++i) {
    const PlacedPiece& first = pieces_[static_cast<std::size_t>(i)];
    if (!Overlap(first.low, first.high, b.low, b.high, margin)) continue;
    for (int j = b.first_piece; j < b.first_piece + b.piece_count; ++j) {
      const PlacedPiece& second = pieces_[static_cast<std::size_t>(j)];
      if (!Overlap(first.low, first.high, second.low, second.high, margin)) continue;
      AddPair(collider_of_piece_[static_cast<std::size_t>(i)], first,
              collider_of_piece_[static_cast<std::size_t>(j)], second, margin);
    }
  }
}

void ContactFinder::AddStaticPairs(const Group& group) {
  const double margin = kContactMargin + group.reach;
  const Vector3 wide{margin, margin, margin};
  for (const StaticPiece& plane : planes_) {
    for (int i = group.first_piece; i < group.first_piece + group.piece_count; ++i) {
      const PlacedPiece& piece = pieces_[static_cast<std::size_t>(i)];
      if (IsAbove(piece, plane.placed, margin)) continue;
      AddPair(collider_of_piece_[static_cast<std::size_t>(i)], piece, plane.collider, plane.placed,
              margin);
    }
  }
  for (int i = group.first_piece; i < group.first_piece + group.piece_count; ++i) {
    const PlacedPiece& piece = pieces_[static_cast<std::size_t>(i)];
    near_.clear();
    static_bvh_.ForEachNear(piece.low - wide, piece.high + wide,
                            [&](int at) { near_.push_back(at); });
    std::sort(near_.begin(), near_.end());
    for (const int at : near_) {
      const StaticPiece& other = statics_[static_cast<std::size_t>(at)];
      AddPair(collider_of_piece_[static_cast<std::size_t>(i)], piece, other.collider, other.placed,
              margin);
    }
  }
}

// Sort and sweep along x.
void ContactFinder::AddGroupPairs(double substep) {
  double farthest = 0;
  order_.clear();
  for (std::size_t i = 0; i < groups_.size(); ++i) {
    Group& group = groups_[i];
    if (group.piece_count == 0) continue;
    if (group.moving >= 0) {
      group.reach = substep * bodies_[static_cast<std::size_t>(group.moving)]->Speed();
    } else {
      const Collider& collider = colliders_[static_cast<std::size_t>(group.first_collider)];
      group.reach = substep * (Norm(collider.velocity) +
                               Norm(collider.angular_velocity) * collider.solid->radius);
    }
    farthest = std::max(farthest, group.reach);
    order_.push_back(static_cast<int>(i));
  }
  const auto at = [&](int index) -> const Group& {
    return groups_[static_cast<std::size_t>(index)];
  };
  std::sort(order_.begin(), order_.end(),
            [&](int a, int b) { return std::pair(at(a).low.x, a) < std::pair(at(b).low.x, b); });
  const auto is_moved = [&](const Group& group) {
    return group.moving >= 0 && bodies_[static_cast<std::size_t>(group.moving)]->tree().size() > 0;
  };
  group_pairs_.clear();
  for (std::size_t i = 0; i < order_.size(); ++i) {
    const Group& a = at(order_[i]);
    for (std::size_t j = i + 1; j < order_.size(); ++j) {
      const Group& b = at(order_[j]);
      if (b.low.x > a.high.x + kContactMargin + a.reach + farthest) break;
      if (!is_moved(a) && !is_moved(b)) continue;
      if (!Overlap(a.low, a.high, b.low, b.high, kContactMargin + a.reach + b.reach)) continue;
      group_pairs_.push_back(std::minmax(order_[i], order_[j]));
    }
  }
  std::sort(group_pairs_.begin(), group_pairs_.end());
}

std::vector<Contact>& ContactFinder::Find(double substep) {
  contacts_.clear();
  AddGroupPairs(substep);
  auto pair = group_pairs_.begin();
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const Group& group = groups_[i];
    if (bodies_[i]->tree().size() > 0 && group.piece_count > 0) AddStaticPairs(group);
    for (; pair != group_pairs_.end() && pair->first == static_cast<int>(i); ++pair) {
      AddGroupPair(group, groups_[static_cast<std::size_t>(pair->second)]);
    }
  }
  SetSoftness(substep);
  return contacts_;
}

}  // namespace gsv::dynamics
