#include "gsv/dynamics/planar/planar_scene.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "gsv/base/check.h"
#include "gsv/dynamics/shapes/obstacles.h"

namespace gsv::dynamics {
namespace {

using geometry::Quaternion;

// Pieces that extend above the climb height by less than this do not collide.
constexpr double kThinnest = 1e-9;

// Returns the rotation without its yaw.
Quaternion TiltOf(const Quaternion& orientation) {
  if (std::abs(orientation.x) < 1e-12 && std::abs(orientation.y) < 1e-12) return {};
  return geometry::FromAxisAngle({0, 0, 1}, -geometry::Yaw(orientation)) * orientation;
}

double SpinRadius(const Footprint& footprint, double reference_x) {
  double radius = 0;
  for (const Footprint::Piece& piece : footprint.pieces) {
    const Vector2 centre = piece.shape.vertices[0];
    // A rotation about the origin moves only the centre of a disc, but also the corners of other
    // pieces.
    const double reach = piece.shape.vertex_count == 1
                             ? std::sqrt(Dot(centre, centre))
                             : std::sqrt(Dot(piece.centre, piece.centre)) + piece.radius;
    radius = std::max(radius, reach);
  }
  // When a base rotates about its reference point, the model's origin moves as well. The bound
  // includes this motion.
  return radius + 2 * std::abs(reference_x);
}

Interval RoundedUp(Interval heights, double quantum) {
  const Interval rounded{std::ceil(heights.low / quantum) * quantum,
                         std::ceil(heights.high / quantum) * quantum};
  return rounded.high > rounded.low ? rounded : Interval{rounded.low, rounded.low + quantum};
}

bool Below(const Interval& a, const Interval& b) {
  return a.low != b.low ? a.low < b.low : a.high < b.high;
}

std::vector<Interval> Distinct(std::vector<Interval> intervals) {
  std::sort(intervals.begin(), intervals.end(), Below);
  intervals.erase(std::unique(intervals.begin(), intervals.end()), intervals.end());
  return intervals;
}

base::Result<MoverKind> MakeKind(const model::Model& model, const Quaternion& tilt) {
  auto kinematics = model.drive ? DriveKinematics::Create(model)
                                : base::Result<DriveKinematics>(DriveKinematics::Free());
  if (!kinematics) return base::Fail(kinematics.error());
  MoverKind kind{*std::move(kinematics), MakeFootprint(model, tilt)};
  kind.climb = ClimbHeight(model, kind.footprint);
  kind.spin_radius = SpinRadius(kind.footprint, kind.kinematics.reference_x());
  return kind;
}

}  // namespace

base::Status PlanarScene::SetLayout(std::shared_ptr<const world::Layout> layout) {
  GSV_CHECK(layout != nullptr);
  std::vector<MoverKind> kinds;
  std::vector<Mover> movers;
  std::vector<int> static_bodies, dynamic;
  // For each model with an upright body, the index in `kinds`. Never iterated, because the order of
  // pointers is not deterministic.
  std::map<const model::Model*, std::uint32_t> known;
  std::uint32_t pieces = 0;
  for (std::size_t i = 0; i < layout->bodies.size(); ++i) {
    const world::Body& body = layout->bodies[i];
    if (!IsFinite(body.initial_pose)) {
      return base::Fail(base::ErrorCode::kInvalidArgument,
                        "the pose contains a number that is not finite", body.name);
    }
    if (!body.is_planar()) {
      (body.is_rigid() || body.is_actor() ? dynamic : static_bodies).push_back(static_cast<int>(i));
      continue;
    }
    const Quaternion tilt = TiltOf(body.initial_pose.orientation);
    const bool is_upright = tilt == Quaternion{};
    const auto found = is_upright ? known.find(body.model.get()) : known.end();
    auto kind = static_cast<std::uint32_t>(kinds.size());
    if (found != known.end()) {
      kind = found->second;
    } else {
      auto made = MakeKind(*body.model, tilt);
      if (!made) return base::Fail(made.error());
      kinds.push_back(*std::move(made));
      if (is_upright) known.emplace(body.model.get(), kind);
    }
    movers.push_back({static_cast<int>(i), kind, pieces, body.first_joint,
                      static_cast<int>(body.model->joints.size())});
    pieces += static_cast<std::uint32_t>(kinds[kind].footprint.pieces.size());
  }
  layout_ = std::move(layout);
  kinds_ = std::move(kinds);
  movers_ = std::move(movers);
  static_bodies_ = std::move(static_bodies);
  dynamic_ = std::move(dynamic);
  dynamic_radii_.clear();
  for (const int body : dynamic_) dynamic_radii_.push_back(DynamicRadius(layout_->bodies[body]));
  levels_.assign(pieces, -1);
  is_sliced_ = false;
  return {};
}

void PlanarScene::Slice(const world::State& state) {
  GSV_CHECK(layout_ != nullptr && state.bodies.size() == layout_->bodies.size());
  heights_.clear();
  for (const Mover& mover : movers_) {
    heights_.push_back(state.bodies[mover.body].world_from_model.position.z);
  }
  static_poses_.clear();
  for (const int body : static_bodies_)
    static_poses_.push_back(state.bodies[body].world_from_model);
  intervals_ = AssignLevels();
  SliceLevels(state);
  is_dynamic_sliced_ = false;
  is_sliced_ = true;
}

void PlanarScene::FindDynamicObstacles(const world::State& state, std::span<const Sight> sights) {
  seen_.clear();
  for (std::size_t i = 0; i < dynamic_.size(); ++i) {
    const auto& origin = state.bodies[dynamic_[i]].world_from_model.position;
    const bool is_seen = std::any_of(sights.begin(), sights.end(), [&](const Sight& sight) {
      const Vector2 apart = Vector2{origin.x, origin.y} - sight.centre;
      const double reach = sight.radius + dynamic_radii_[i];
      return Dot(apart, apart) <= reach * reach;
    });
    if (is_seen) seen_.push_back(dynamic_[i]);
  }
}

void PlanarScene::SliceDynamicObstacles(const world::State& state, std::span<const Sight> sights) {
  if (dynamic_.empty()) return;
  FindDynamicObstacles(state, sights);
  std::vector<double> now;
  for (const int body : seen_) {
    const auto& [p, q] = state.bodies[body].world_from_model;
    now.insert(now.end(), {static_cast<double>(body), p.x, p.y, p.z, q.w, q.x, q.y, q.z});
    const auto first = state.joint_positions.begin() + layout_->bodies[body].first_joint;
    now.insert(now.end(), first,
               first + static_cast<std::ptrdiff_t>(layout_->bodies[body].model->joints.size()));
  }
  if (is_dynamic_sliced_ && now == dynamic_state_) return;
  is_dynamic_sliced_ = true;
  dynamic_state_ = std::move(now);
  dynamic_fields_.clear();
  const std::vector<double> margins = MarginsOfLevels();
  for (std::size_t i = 0; i < intervals_.size(); ++i) {
    const Interval heights{intervals_[i].low, intervals_[i].high - kRides};
    auto obstacles = heights.high > heights.low
                         ? CollectDynamicObstacles(*layout_, state, seen_, heights)
                         : std::vector<Obstacle>{};
    dynamic_fields_.emplace_back(std::move(obstacles), margins[i]);
  }
}

bool PlanarScene::HasValidSlices(const world::State& state) const {
  GSV_CHECK(layout_ != nullptr && state.bodies.size() == layout_->bodies.size());
  if (!is_sliced_) return false;
  for (std::size_t i = 0; i < static_bodies_.size(); ++i) {
    if (state.bodies[static_bodies_[i]].world_from_model != static_poses_[i]) return false;
  }
  return true;
}

std::vector<Interval> PlanarScene::AssignLevels() {
  struct Wanted {
    std::size_t mover, piece;
    Interval heights;
  };
  std::vector<Wanted> wanted;
  std::fill(levels_.begin(), levels_.end(), -1);
  for (std::size_t m = 0; m < movers_.size(); ++m) {
    const MoverKind& mover_kind = kind(movers_[m]);
    const Footprint& footprint = mover_kind.footprint;
    for (std::size_t p = 0; p < footprint.pieces.size(); ++p) {
      const Interval piece = footprint.pieces[p].heights;
      const Interval heights{
          heights_[m] + std::max(piece.low, footprint.heights.low + mover_kind.climb),
          heights_[m] + piece.high};
      if (heights.high - heights.low > kThinnest) wanted.push_back({m, p, heights});
    }
  }
  const auto intervals = [&](double quantum) {
    std::vector<Interval> all;
    all.reserve(wanted.size());
    for (Wanted& w : wanted) {
      all.push_back(quantum > 0 ? RoundedUp(w.heights, quantum) : w.heights);
    }
    return all;
  };
  double quantum = 0;
  std::vector<Interval> levels = Distinct(intervals(quantum));
  while (levels.size() > kMaxLevels) {
    quantum = std::max(1e-3, 2 * quantum);
    levels = Distinct(intervals(quantum));
  }
  const std::vector<Interval> of_wanted = intervals(quantum);
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    const auto level = std::lower_bound(levels.begin(), levels.end(), of_wanted[i], Below);
    levels_[movers_[wanted[i].mover].first_level + wanted[i].piece] =
        static_cast<int>(level - levels.begin());
  }
  return levels;
}

std::vector<double> PlanarScene::MarginsOfLevels() const {
  std::vector<double> margins(intervals_.size(), kLookAround);
  for (const Mover& mover : movers_) {
    const Footprint& footprint = kind(mover).footprint;
    for (std::size_t p = 0; p < footprint.pieces.size(); ++p) {
      if (level(mover, p) < 0) continue;
      double& margin = margins[level(mover, p)];
      margin = std::max(margin, footprint.radius + kLookAround);
    }
  }
  return margins;
}

void PlanarScene::SliceLevels(const world::State& state) {
  const std::vector<double> margins = MarginsOfLevels();
  fields_.clear();
  for (std::size_t i = 0; i < intervals_.size(); ++i) {
    fields_.emplace_back(CollectObstacles(*layout_, state, intervals_[i]), margins[i]);
  }
}

}  // namespace gsv::dynamics
