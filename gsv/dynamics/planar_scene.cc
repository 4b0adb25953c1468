#include "gsv/dynamics/planar_scene.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "gsv/base/check.h"
#include "gsv/dynamics/obstacles.h"

namespace gsv::dynamics {
namespace {

using geometry::Quaternion;

// Pieces thinner than this above the climbing height run into nothing.
constexpr double kThinnest = 1e-9;
// How far a base is expected to move in a step, for the size of grid cells.
constexpr double kUsualTravel = 0.05;

// The part of a pose's rotation that is not about the vertical.
Quaternion TiltOf(const Quaternion& orientation) {
  if (std::abs(orientation.x) < 1e-12 && std::abs(orientation.y) < 1e-12) return {};
  return geometry::FromAxisAngle({0, 0, 1}, -geometry::Yaw(orientation)) * orientation;
}

double SpinRadius(const Footprint& footprint, double reference_x) {
  double radius = 0;
  for (const Footprint::Piece& piece : footprint.pieces) {
    const Vector2 centre = piece.shape.vertices[0];
    // A disc about the origin turns on the spot without moving.
    const double reach = piece.shape.vertex_count == 1
                             ? std::sqrt(Dot(centre, centre))
                             : std::sqrt(Dot(piece.centre, piece.centre)) + piece.radius;
    radius = std::max(radius, reach);
  }
  // A slide and a turn on the spot may follow an arc.
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

}  // namespace

base::Status PlanarScene::SetLayout(std::shared_ptr<const world::Layout> layout) {
  GSV_CHECK(layout != nullptr);
  std::vector<Mover> movers;
  std::vector<int> standing;
  std::map<const model::Model*, Mover> prototypes;  // looked up only, never walked through
  for (std::size_t i = 0; i < layout->bodies.size(); ++i) {
    const world::Body& body = layout->bodies[i];
    if (!IsFinite(body.initial_pose)) {
      return base::Fail(base::ErrorCode::kInvalidArgument,
                        "the pose holds a number that is not finite", body.name);
    }
    if (!IsDriven(body)) {
      standing.push_back(static_cast<int>(i));
      continue;
    }
    const Quaternion tilt = TiltOf(body.initial_pose.orientation);
    const auto known = prototypes.find(body.model.get());
    Mover mover;
    if (known != prototypes.end() && tilt == Quaternion{}) {
      mover = known->second;
    } else {
      auto kinematics = body.model->drive ? DriveKinematics::Create(*body.model)
                                          : base::Result<DriveKinematics>(DriveKinematics::Free());
      if (!kinematics) return base::Fail(kinematics.error());
      mover.kinematics = std::make_shared<const DriveKinematics>(*std::move(kinematics));
      mover.footprint = std::make_shared<const Footprint>(MakeFootprint(*body.model, tilt));
      mover.climb = ClimbHeight(*body.model, *mover.footprint);
      mover.spin_radius = SpinRadius(*mover.footprint, mover.kinematics->reference_x());
      if (tilt == Quaternion{}) prototypes.emplace(body.model.get(), mover);
    }
    mover.body = static_cast<int>(i);
    movers.push_back(std::move(mover));
  }
  layout_ = std::move(layout);
  movers_ = std::move(movers);
  standing_ = std::move(standing);
  sliced_ = false;
  return {};
}

void PlanarScene::Prepare(const world::State& state) {
  GSV_CHECK(layout_ != nullptr && state.bodies.size() == layout_->bodies.size());
  if (IsCurrent(state)) return;
  heights_.clear();
  for (const Mover& mover : movers_) {
    heights_.push_back(state.bodies[mover.body].world_from_model.position.z);
  }
  standing_poses_.clear();
  for (const int body : standing_) standing_poses_.push_back(state.bodies[body].world_from_model);
  SliceLevels(AssignLevels(), state);
  sliced_ = true;
}

bool PlanarScene::IsCurrent(const world::State& state) const {
  if (!sliced_) return false;
  for (std::size_t m = 0; m < movers_.size(); ++m) {
    if (state.bodies[movers_[m].body].world_from_model.position.z != heights_[m]) return false;
  }
  for (std::size_t i = 0; i < standing_.size(); ++i) {
    if (state.bodies[standing_[i]].world_from_model != standing_poses_[i]) return false;
  }
  return true;
}

std::vector<Interval> PlanarScene::AssignLevels() {
  struct Wanted {
    std::size_t mover, piece;
    Interval heights;
  };
  std::vector<Wanted> wanted;
  for (std::size_t m = 0; m < movers_.size(); ++m) {
    Mover& mover = movers_[m];
    const Footprint& footprint = *mover.footprint;
    mover.levels.assign(footprint.pieces.size(), -1);
    for (std::size_t p = 0; p < footprint.pieces.size(); ++p) {
      const Interval piece = footprint.pieces[p].heights;
      const Interval heights{heights_[m] + std::max(piece.low, footprint.heights.low + mover.climb),
                             heights_[m] + piece.high};
      if (heights.high - heights.low > kThinnest) wanted.push_back({m, p, heights});
    }
  }
  const auto intervals = [&](double quantum) {
    std::vector<Interval> all;
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
    movers_[wanted[i].mover].levels[wanted[i].piece] = static_cast<int>(level - levels.begin());
  }
  return levels;
}

void PlanarScene::SliceLevels(const std::vector<Interval>& levels, const world::State& state) {
  std::vector<double> widest(levels.size(), 0.0);
  for (const Mover& mover : movers_) {
    for (std::size_t p = 0; p < mover.levels.size(); ++p) {
      if (mover.levels[p] < 0) continue;
      double& radius = widest[mover.levels[p]];
      radius = std::max(radius, mover.footprint->pieces[p].radius);
    }
  }
  fields_.clear();
  for (std::size_t i = 0; i < levels.size(); ++i) {
    fields_.emplace_back(CollectObstacles(*layout_, state, levels[i]), widest[i] + kUsualTravel);
  }
}

}  // namespace gsv::dynamics
