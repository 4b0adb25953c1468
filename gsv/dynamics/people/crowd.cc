#include "gsv/dynamics/people/crowd.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "gsv/dynamics/people/social_force.h"
#include "gsv/dynamics/shapes/obstacles.h"

namespace gsv::dynamics {
namespace {

constexpr double kTurningTime = 0.3;   // s
constexpr double kMaxTurnRate = 4;     // rad/s
constexpr double kStandsStill = 0.05;  // m/s: a slower pedestrian keeps its heading
// Cosine of 60 degrees. Obstacles within this angle count as one obstacle.
constexpr double kSameSide = 0.5;
constexpr double kRoundingOfCells = 1e-9;

// The height of a body's highest point above its origin. Approximate for a body that is not
// upright.
double HeightOf(const model::Model& model) {
  double top = 0;
  for (const model::Link& link : model.links) {
    for (const model::Collision& collision : link.collisions) {
      const geometry::Bounds bounds = geometry::BoundsOf(collision.shape);
      const geometry::Vector3 middle = link.model_from_link * (collision.link_from_collision *
                                                               ((bounds.min + bounds.max) * 0.5));
      top = std::max(top, middle.z + (bounds.max.z - bounds.min.z) / 2);
    }
  }
  return top;
}

}  // namespace

void Crowd::SetLayout(std::shared_ptr<const world::Layout> layout) {
  layout_ = std::move(layout);
  walkers_.clear();
  levels_.clear();
  standing_.clear();
  others_.clear();
  is_sliced_ = false;
  const std::vector<world::Body>& bodies = layout_->bodies;
  if (std::none_of(bodies.begin(), bodies.end(),
                   [](const world::Body& body) { return body.is_pedestrian(); })) {
    return;
  }
  for (int i = 0; i < static_cast<int>(bodies.size()); ++i) {
    const world::Body& body = bodies[static_cast<std::size_t>(i)];
    if (!body.is_planar() && !body.is_rigid() && !body.is_actor()) {
      standing_.push_back(i);
      continue;
    }
    const double radius =
        body.is_pedestrian() ? body.pedestrian->group->radius : model::FootprintRadius(*body.model);
    if (radius > 0 && radius <= kMaxRadius) {
      const int walker = body.is_pedestrian() ? static_cast<int>(walkers_.size()) : -1;
      others_.push_back({i, walker, radius, HeightOf(*body.model), {}, {}, 0});
    }
    if (!body.is_pedestrian()) continue;
    const double feet = body.initial_pose.position.z;
    const Interval level{feet + kStep, feet + body.pedestrian->group->height};
    const auto same = [&](const Interval& each) {
      return each.low == level.low && each.high == level.high;
    };
    const auto found = std::find_if(levels_.begin(), levels_.end(), same);
    Walker walker;
    walker.body = i;
    walker.pedestrian = body.pedestrian.get();
    walker.level = static_cast<std::size_t>(found - levels_.begin());
    if (found == levels_.end()) levels_.push_back(level);
    walkers_.push_back(walker);
  }
}

void Crowd::SliceWalls(const world::State& state) {
  const auto stands_as_sliced = [&] {
    for (std::size_t i = 0; i < standing_.size(); ++i) {
      if (state.bodies[static_cast<std::size_t>(standing_[i])].world_from_model != poses_[i]) {
        return false;
      }
    }
    return true;
  };
  if (is_sliced_ && stands_as_sliced()) return;
  poses_.clear();
  for (const int body : standing_) {
    poses_.push_back(state.bodies[static_cast<std::size_t>(body)].world_from_model);
  }
  walls_.clear();
  for (const Interval& level : levels_) {
    walls_.emplace_back(CollectObstacles(*layout_, state, level), kWallsReach);
  }
  is_sliced_ = true;
}

// Sorts others_, the bodies that pedestrians avoid, into grid cells (counting sort). The order of
// bodies within a cell is kept.
void Crowd::SortOthers(const world::State& state) {
  Vector2 low, high;
  for (std::size_t i = 0; i < others_.size(); ++i) {
    Other& other = others_[i];
    const world::BodyState& body = state.bodies[static_cast<std::size_t>(other.body)];
    const geometry::Vector3& at = body.world_from_model.position;
    other.at = {at.x, at.y};
    other.z = at.z;
    other.velocity = {body.linear_velocity.x, body.linear_velocity.y};
    if (i == 0) low = high = other.at;
    low = {std::min(low.x, at.x), std::min(low.y, at.y)};
    high = {std::max(high.x, at.x), std::max(high.y, at.y)};
  }
  const double wide = high.x - low.x, tall = high.y - low.y;
  const double most_cells = 4.0 * static_cast<double>(others_.size()) + 64;
  double cell = kOthersReach;
  while ((wide / cell + 1) * (tall / cell + 1) > most_cells) cell *= 1.5;
  left_ = low.x;
  bottom_ = low.y;
  per_cell_ = (1 - kRoundingOfCells) / cell;
  columns_ = static_cast<int>(wide * per_cell_) + 1;
  rows_ = static_cast<int>(tall * per_cell_) + 1;
  cell_start_.assign(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_) + 1, 0);
  cell_of_.resize(others_.size());
  sorted_.resize(others_.size());
  sorted_at_.resize(others_.size());
  for (std::size_t i = 0; i < others_.size(); ++i) {
    const int column = static_cast<int>((others_[i].at.x - left_) * per_cell_);
    const int row = static_cast<int>((others_[i].at.y - bottom_) * per_cell_);
    cell_of_[i] = static_cast<std::uint32_t>(row * columns_ + column);
    ++cell_start_[cell_of_[i]];
  }
  for (std::size_t c = 1; c < cell_start_.size(); ++c) cell_start_[c] += cell_start_[c - 1];
  // Fills each cell from its last entry to its first. Afterwards, cell_start_ has the index of the
  // first entry of each cell.
  for (std::size_t i = others_.size(); i-- > 0;) {
    const std::uint32_t place = --cell_start_[cell_of_[i]];
    sorted_[place] = others_[i];
    sorted_at_[place] = others_[i].at;
  }
  walker_order_.clear();
  for (const Other& other : sorted_) {
    if (other.walker >= 0) walker_order_.push_back(static_cast<std::uint32_t>(other.walker));
  }
}

void Crowd::AddForcesOfOthers(const Walker& walker, std::uint32_t index,
                              const world::BodyState& body, Block& block) const {
  const geometry::Vector3& position = body.world_from_model.position;
  const Vector2 at{position.x, position.y};
  const model::PedestrianGroup& group = *walker.pedestrian->group;
  const int column = static_cast<int>((at.x - left_) * per_cell_);
  const int row = static_cast<int>((at.y - bottom_) * per_cell_);
  for (int r = std::max(0, row - 1); r <= std::min(rows_ - 1, row + 1); ++r) {
    // The cells of one row are adjacent in sorted_.
    const int first = r * columns_ + std::max(0, column - 1);
    const int last = r * columns_ + std::min(columns_ - 1, column + 1);
    const std::uint32_t end = cell_start_[static_cast<std::size_t>(last) + 1];
    for (std::uint32_t k = cell_start_[static_cast<std::size_t>(first)]; k < end; ++k) {
      const Vector2 between = at - sorted_at_[k];
      if (!(Dot(between, between) < kOthersReach * kOthersReach)) continue;
      const Other& other = sorted_[k];
      if (other.body == walker.body) continue;
      if (other.z > position.z + group.height || other.z + other.height < position.z) continue;
      block.repulsions.Add(index, between, group.radius + other.radius, other.velocity,
                           block.directions[index], block.forces);
    }
  }
}

Vector2 Crowd::ForceOfWalls(const Walker& walker, Vector2 at) const {
  struct Side {
    double distance;
    Vector2 away;
  };
  std::array<Side, 16> near;  // the nearest obstacles, in ascending order of distance
  std::size_t count = 0;
  const ConvexPiece point = Disc(at, 0);
  const ObstacleField& walls = walls_[walker.level];
  walls.ForEachNear(at, kWallsReach, [&](std::uint32_t index) {
    if (DistanceTo(walls[index].shape, at) > kWallsReach) return;
    const Separation separation = Separate(point, walls[index].shape);
    if (count == near.size() && separation.distance >= near.back().distance) return;
    std::size_t i = count < near.size() ? count++ : count - 1;
    for (; i > 0 && near[i - 1].distance > separation.distance; --i) near[i] = near[i - 1];
    near[i] = {separation.distance, -1.0 * separation.normal};
  });
  Vector2 force;
  std::size_t sides = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const auto is_same = [&](const Side& side) { return Dot(side.away, near[i].away) > kSameSide; };
    if (std::any_of(near.begin(), near.begin() + static_cast<std::ptrdiff_t>(sides), is_same)) {
      continue;
    }
    near[sides++] = near[i];
    force = force + RepulsionByWall(near[i].away, near[i].distance);
  }
  return force;
}

Vector2 Crowd::DirectionOf(Walker& walker, world::State& state) const {
  const auto index = static_cast<std::size_t>(walker.body);
  const geometry::Vector3& position = state.bodies[index].world_from_model.position;
  std::uint32_t& reached = state.goals[index];
  const auto way_to_goal = [&] {
    if (!walker.has_goal || walker.reached != reached) {
      walker.goal = world::GoalOf(*walker.pedestrian, reached);
      walker.reached = reached;
      walker.has_goal = true;
    }
    return walker.goal - Vector2{position.x, position.y};
  };
  Vector2 way = way_to_goal();
  if (Dot(way, way) < kArrival * kArrival) {
    ++reached;
    way = way_to_goal();
  }
  const double length = std::sqrt(Dot(way, way));
  return length > kNoLength ? (1 / length) * way : Vector2{};
}

void Crowd::Command(const Walker& walker, Vector2 direction, Vector2 force, double seconds,
                    double left, world::State& state) const {
  world::BodyState& body = state.bodies[static_cast<std::size_t>(walker.body)];
  const double speed = walker.pedestrian->speed;
  const Vector2 velocity = NextVelocity({body.linear_velocity.x, body.linear_velocity.y},
                                        speed * direction, force, speed, seconds, left);
  const double yaw = geometry::Yaw(body.world_from_model.orientation);
  double turn = 0;
  if (Dot(velocity, velocity) > kStandsStill * kStandsStill) {
    const double error = geometry::WrapAngle(std::atan2(velocity.y, velocity.x) - yaw);
    turn = std::clamp(error / std::max(kTurningTime, seconds), -kMaxTurnRate, kMaxTurnRate);
  }
  // The command is in the body's frame, which rotates by turn * seconds during the step. The
  // velocity is converted to this frame's orientation at the end of the step.
  const double cosine = std::cos(yaw + turn * seconds), sine = std::sin(yaw + turn * seconds);
  body.drive.command = {cosine * velocity.x + sine * velocity.y,
                        cosine * velocity.y - sine * velocity.x, turn};
  body.drive.command_time = state.time;
}

void Crowd::DecideFor(std::span<const std::uint32_t> walkers, double seconds, double left,
                      Block& block, world::State& state) {
  for (std::uint32_t i = 0; i < walkers.size(); ++i) {
    Walker& walker = walkers_[walkers[i]];
    block.directions[i] = DirectionOf(walker, state);
    block.forces[i] = {};
    AddForcesOfOthers(walker, i, state.bodies[static_cast<std::size_t>(walker.body)], block);
  }
  block.repulsions.Finish(block.forces);
  for (std::size_t i = 0; i < walkers.size(); ++i) {
    const Walker& walker = walkers_[walkers[i]];
    const geometry::Vector3& position =
        state.bodies[static_cast<std::size_t>(walker.body)].world_from_model.position;
    const Vector2 force = block.forces[i] + ForceOfWalls(walker, {position.x, position.y});
    Command(walker, block.directions[i], force, seconds, left, state);
  }
}

void Crowd::Decide(base::SimTime step, world::State& state) {
  if (walkers_.empty()) return;
  SliceWalls(state);
  SortOthers(state);
  const double seconds = base::ToSeconds(step), left = Relaxation(seconds);
  team_->ParallelFor(walker_order_.size(), kBlock, [&](std::size_t begin, std::size_t end) {
    Block block;
    const std::span<const std::uint32_t> order(walker_order_);
    for (; begin < end; begin += kBlock) {
      DecideFor(order.subspan(begin, std::min(kBlock, end - begin)), seconds, left, block, state);
    }
  });
}

}  // namespace gsv::dynamics
