#include "gsv/simulation/editing/crowd_placement.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>
#include <utility>

#include "gsv/base/random.h"
#include "gsv/world/pedestrian.h"

namespace gsv::simulation {
namespace {

using geometry::Vector2;

constexpr double kGap = 0.05;  // minimum gap between two pedestrians, m
// Cell size, m. The radius of a pedestrian is at most 1 m. So two pedestrians without the minimum gap
// are in the same cell or in neighbouring cells.
constexpr double kCell = 2 + kGap;
constexpr double kOverlap = 1e-3;  // overlap that is tolerated, m
constexpr std::uint32_t kAttempts = 400;
constexpr int kRounds = 40;

class CrowdPlacement {
 public:
  CrowdPlacement(const world::Layout& layout, std::uint64_t seed) : layout_(layout), seed_(seed) {}

  void AddGroup(const std::shared_ptr<const model::PedestrianGroup>& group) {
    std::array<std::shared_ptr<const model::Model>, model::kPedestrianLooks> looks;
    for (int i = 0; i < model::kPedestrianLooks; ++i) looks[i] = PedestrianModel(*group, i);
    for (int i = 0; i < group->count; ++i) {
      world::Body body;
      do {
        body.name = group->name + "_" + std::to_string(++numbers_[group->name]);
      } while (layout_.Find(body.name) >= 0);
      // A sensor's random stream has the name ROBOT/SENSOR. This name contains no slash, so no
      // sensor uses the same stream.
      const std::uint64_t stream = base::StableId("pedestrian " + body.name);
      body.model = looks[stream % looks.size()];
      body.kind = world::BodyKind::kPedestrian;
      body.pedestrian =
          std::make_shared<const world::Pedestrian>(world::DrawPedestrian(group, seed_, stream));
      body.initial_pose.position.z = group->z;
      members_.push_back(std::move(body));
      attempts_.push_back(0);
    }
  }

  base::Result<std::shared_ptr<const world::Layout>> Place(dynamics::Engine& engine) {
    if (auto ok = engine.SetLayout(MakeLayout()); !ok) return base::Fail(ok.error());
    std::vector<std::size_t> pending(members_.size());
    for (std::size_t i = 0; i < pending.size(); ++i) pending[i] = i;
    for (int round = 0; round < kRounds && !pending.empty(); ++round) {
      for (const std::size_t member : pending) {
        if (!FindPlace(member)) return NoRoom(member);
      }
      pending = TakeOverlapping(engine);
    }
    if (!pending.empty()) return NoRoom(pending.front());
    auto layout = MakeLayout();
    if (auto ok = engine.SetLayout(layout); !ok) return base::Fail(ok.error());
    return layout;
  }

 private:
  using Cell = std::pair<int, int>;

  std::shared_ptr<const world::Layout> MakeLayout() const {
    std::vector<world::Body> bodies = layout_.bodies;
    bodies.insert(bodies.end(), members_.begin(), members_.end());
    return world::MakeLayout(layout_.version, std::move(bodies), layout_.description);
  }

  static Cell CellOf(Vector2 at) {
    return {static_cast<int>(std::floor(at.x / kCell)), static_cast<int>(std::floor(at.y / kCell))};
  }

  bool IsFree(std::size_t member, Vector2 at) const {
    const auto [column, row] = CellOf(at);
    const double radius = members_[member].pedestrian->group->radius;
    for (int c = column - 1; c <= column + 1; ++c) {
      for (int r = row - 1; r <= row + 1; ++r) {
        const auto cell = taken_.find({c, r});
        if (cell == taken_.end()) continue;
        for (const std::size_t other : cell->second) {
          const geometry::Vector3& there = members_[other].initial_pose.position;
          const double room = radius + members_[other].pedestrian->group->radius + kGap;
          if (std::hypot(at.x - there.x, at.y - there.y) < room) return false;
        }
      }
    }
    return true;
  }

  bool FindPlace(std::size_t member) {
    world::Body& body = members_[member];
    while (attempts_[member] < kAttempts) {
      const Vector2 at = world::StartOf(*body.pedestrian, attempts_[member]++);
      if (!IsFree(member, at)) continue;
      const Vector2 way = world::GoalOf(*body.pedestrian, 0) - at;
      body.initial_pose =
          geometry::PlanarPose(at.x, at.y, body.initial_pose.position.z, std::atan2(way.y, way.x));
      taken_[CellOf(at)].push_back(member);
      return true;
    }
    return false;
  }

  // Finds the pedestrians that overlap a body, and removes them from their places.
  std::vector<std::size_t> TakeOverlapping(dynamics::Engine& engine) {
    const auto layout = MakeLayout();
    const world::State state = world::InitialState(*layout);
    std::vector<bool> overlaps(layout->bodies.size(), false);
    for (const world::Contact& overlap : engine.Overlaps(state, kOverlap)) {
      overlaps[static_cast<std::size_t>(overlap.first)] = true;
    }
    std::vector<std::size_t> taken;
    for (std::size_t member = 0; member < members_.size(); ++member) {
      const world::Body& body = members_[member];
      if (!overlaps[static_cast<std::size_t>(layout->Find(body.name))]) continue;
      const geometry::Vector3& at = body.initial_pose.position;
      std::erase(taken_[CellOf({at.x, at.y})], member);
      taken.push_back(member);
    }
    return taken;
  }

  base::Failure<base::Error> NoRoom(std::size_t member) const {
    return base::Fail(base::ErrorCode::kInvalidArgument,
                      "there is no free place for this pedestrian on its route: use fewer "
                      "pedestrians, or wider goals",
                      members_[member].name);
  }

  const world::Layout& layout_;
  const std::uint64_t seed_;
  // The number in the newest name, such as 3 for "crowd_3". The key is the name of the group.
  std::map<std::string, int> numbers_;
  std::vector<world::Body> members_;
  // The number of places that were tried for each element of `members_`.
  std::vector<std::uint32_t> attempts_;
  // The pedestrians that have a place (indices in `members_`), by cell. The map is never iterated.
  std::map<Cell, std::vector<std::size_t>> taken_;
};

}  // namespace

base::Result<std::shared_ptr<const world::Layout>> PlacePedestrians(
    const world::Layout& layout,
    const std::vector<std::shared_ptr<const model::PedestrianGroup>>& groups, std::uint64_t seed,
    dynamics::Engine& engine) {
  CrowdPlacement placement(layout, seed);
  int left = model::kMaxPedestrians;
  for (const auto& group : groups) {
    if (auto ok = model::Check(*group); !ok) return base::Fail(ok.error());
    left -= group->count;
    if (left < 0) {
      return base::Fail(base::ErrorCode::kInvalidArgument,
                        "a world has at most 100,000 pedestrians", group->name);
    }
    placement.AddGroup(group);
  }
  return placement.Place(engine);
}

}  // namespace gsv::simulation
