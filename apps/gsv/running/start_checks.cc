#include "apps/gsv/running/start_checks.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <string>

#include <fmt/format.h>

#include "gsv/geometry/box_corners.h"
#include "gsv/sensing/rays/ray_scene.h"

namespace gsv::app {
namespace {

using geometry::Vector3;

constexpr double kUnbounded = std::numeric_limits<double>::infinity();
constexpr double kFullTurn = 2 * std::numbers::pi + 1e-6;  // in rad
constexpr double kFar = 20;         // minimum distance from the bodies for a warning, m
constexpr double kFloorTop = 0.1;   // a body whose top is below this is a floor and not a wall, m
constexpr double kRayHeight = 0.3;  // height above the floor of the rays that detect walls, m
constexpr int kDirections = 64;
// The world is enclosed if at least this fraction of the rays from its centre hit a wall.
constexpr double kEnclosed = 0.9;
// A start is outside of the walls if less than this fraction of the rays from the start hit a wall.
constexpr double kOutside = 0.75;
constexpr double kMaxDrop = 100;  // maximum depth of the search for a floor, m
constexpr double kSight = 1000;   // maximum range of the rays, m
constexpr int kMaxChecked = 200;  // maximum number of robots of a crowd that are checked

// The horizontal extent of all bodies except robots, floors and planes.
struct Extent {
  double min_x = kUnbounded, min_y = kUnbounded, max_x = -kUnbounded, max_y = -kUnbounded;

  bool is_empty() const { return min_x > max_x; }
  void Add(const Vector3& p) {
    min_x = std::min(min_x, p.x), max_x = std::max(max_x, p.x);
    min_y = std::min(min_y, p.y), max_y = std::max(max_y, p.y);
  }
  double DistanceTo(double x, double y) const {
    return std::hypot(std::max({min_x - x, 0.0, x - max_x}), std::max({min_y - y, 0.0, y - max_y}));
  }
  double size() const { return std::hypot(max_x - min_x, max_y - min_y); }
};

void AddThings(const world::Snapshot& snapshot, int body, Extent& extent) {
  const model::Model& model = *snapshot.layout->bodies[static_cast<std::size_t>(body)].model;
  const std::vector<geometry::Pose> world_from_link = world::LinkPoses(snapshot, body);
  for (std::size_t link = 0; link < model.links.size(); ++link) {
    for (const model::Collision& collision : model.links[link].collisions) {
      if (std::holds_alternative<geometry::Plane>(collision.shape)) continue;
      const geometry::Pose world_from_collision =
          world_from_link[link] * collision.link_from_collision;
      auto corners = geometry::CornersOf(geometry::BoundsOf(collision.shape));
      for (Vector3& corner : corners) corner = world_from_collision * corner;
      const bool is_floor = std::all_of(corners.begin(), corners.end(),
                                        [](const Vector3& each) { return each.z < kFloorTop; });
      if (is_floor) continue;
      for (const Vector3& corner : corners) extent.Add(corner);
    }
  }
}

class StartCheck {
 public:
  explicit StartCheck(std::shared_ptr<const world::Snapshot> snapshot)
      : snapshot_(std::move(snapshot)) {
    const auto& bodies = snapshot_->layout->bodies;
    for (std::size_t body = 0; body < bodies.size(); ++body) {
      if (bodies[body].is_robot()) continue;
      AddThings(*snapshot_, static_cast<int>(body), things_);
      if (bodies[body].is_static()) AddThings(*snapshot_, static_cast<int>(body), walls_);
    }
  }

  void Check(const char* list, const std::vector<scenario::RobotEntry>& entries) {
    for (const scenario::RobotEntry& entry : entries) {
      if (!entry.start) continue;
      where_ = fmt::format("{} {}@{:g},{:g}", list, entry.model.empty() ? entry.name : entry.model,
                           entry.start->x, entry.start->y);
      CheckHeading(*entry.start);
      const int body = snapshot_->layout->Find(entry.name);
      if (body < 0 || ++checked_ > kMaxChecked) continue;
      CheckPlace(*entry.start, body);
    }
  }

  base::Problems Take() { return std::move(problems_); }

 private:
  void Warn(std::string message) {
    problems_.push_back({base::Problem::Severity::kWarning, std::move(message), where_});
  }

  void CheckHeading(const scenario::Place& start) {
    if (std::abs(start.yaw) <= kFullTurn) return;
    Warn(fmt::format("its yaw of {0:g} rad is more than a full turn; for degrees, write {0:g}deg",
                     start.yaw));
  }

  void CheckPlace(const scenario::Place& start, int body) {
    const world::Body& robot = snapshot_->layout->bodies[static_cast<std::size_t>(body)];
    if (robot.is_rigid() && !HasFloor(start, body)) {
      Warn("there is no ground below it, so it falls");
    }
    if (things_.is_empty()) return;
    const double distance = things_.DistanceTo(start.x, start.y);
    if (distance <= 0) return;
    const std::string extent =
        fmt::format("x from {:.1f} to {:.1f} m, y from {:.1f} to {:.1f} m", things_.min_x,
                    things_.max_x, things_.min_y, things_.max_y);
    if (distance > kFar + things_.size()) {
      Warn(fmt::format("it starts {:.0f} m away from all objects of the world ({})", distance,
                       extent));
    } else if (IsWorldEnclosed() && Walls(start.x, start.y, body) < kOutside) {
      Warn(fmt::format("it starts outside the walls that enclose the world ({})", extent));
    }
  }

  const sensing::RayScene& Rays() {
    if (scene_ == nullptr) scene_ = rays_.At(snapshot_);
    return *scene_;
  }

  bool HasFloor(const scenario::Place& start, int body) {
    const double z =
        snapshot_->state.bodies[static_cast<std::size_t>(body)].world_from_model.position.z;
    return std::isfinite(
        Rays().Range({{start.x, start.y, z + kRayHeight}, {0, 0, -1}, kMaxDrop}, body));
  }

  // Returns the fraction of directions in which there is an obstacle, as seen from this place.
  double Walls(double x, double y, int ignored_body) {
    int hits = 0;
    for (int i = 0; i < kDirections; ++i) {
      const double angle = 2 * std::numbers::pi * (i + 0.5) / kDirections;
      const sensing::Ray ray{{x, y, kRayHeight}, {std::cos(angle), std::sin(angle), 0}, kSight};
      if (std::isfinite(Rays().Range(ray, ignored_body))) ++hits;
    }
    return static_cast<double>(hits) / kDirections;
  }

  // Whether the place is inside a solid. A ray up from there ends at the top face of the solid, and
  // so does a ray down from above. Below a roof, the two rays end at different faces.
  bool IsInSolid(double x, double y) {
    const double up = Rays().Range({{x, y, kRayHeight}, {0, 0, 1}, kSight}, -1);
    if (!std::isfinite(up)) return false;
    const double down = Rays().Range({{x, y, kRayHeight + up + 1}, {0, 0, -1}, kSight}, -1);
    return std::abs(down - 1) < 1e-3;
  }

  // Whether walls surround the middle of the world. Bodies that can move are no walls.
  bool IsWorldEnclosed() {
    if (walls_.is_empty()) return false;
    if (!is_enclosed_) {
      const double x = (walls_.min_x + walls_.max_x) / 2;
      const double y = (walls_.min_y + walls_.max_y) / 2;
      is_enclosed_ = !IsInSolid(x, y) && Walls(x, y, -1) >= kEnclosed;
    }
    return *is_enclosed_;
  }

  const std::shared_ptr<const world::Snapshot> snapshot_;
  Extent things_;
  Extent walls_;  // extent of the static bodies
  sensing::RaySceneCache rays_;
  std::shared_ptr<const sensing::RayScene> scene_;
  std::optional<bool> is_enclosed_;
  int checked_ = 0;
  std::string where_;
  base::Problems problems_;
};

}  // namespace

base::Problems CheckStarts(const std::shared_ptr<const world::Snapshot>& snapshot,
                           const scenario::Scenario& scenario) {
  StartCheck check(snapshot);
  check.Check("--robot", scenario.robots);
  check.Check("--avatar", scenario.avatars);
  return check.Take();
}

}  // namespace gsv::app
