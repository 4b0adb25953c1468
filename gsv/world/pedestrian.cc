#include "gsv/world/pedestrian.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "gsv/base/random.h"

namespace gsv::world {
namespace {

using geometry::Vector2;

// Indices of the random draws in a pedestrian's stream: 0 for its properties, then one for each
// goal, then one for each attempt to find a start.
constexpr std::uint64_t kFirstGoal = 1;
constexpr std::uint64_t kFirstAttempt = 1ULL << 40;

Vector2 DrawWithin(const model::PedestrianGoal& goal, base::Noise& noise) {
  const double distance = goal.radius * std::sqrt(noise.Uniform());
  const double angle = 2 * std::numbers::pi * noise.Uniform();
  return {goal.x + distance * std::cos(angle), goal.y + distance * std::sin(angle)};
}

const model::PedestrianGoal& GoalAt(const Pedestrian& pedestrian, std::uint64_t index) {
  const auto& route = pedestrian.group->route;
  return route[index % route.size()];
}

}  // namespace

Pedestrian DrawPedestrian(std::shared_ptr<const model::PedestrianGroup> group, std::uint64_t seed,
                          std::uint64_t stream) {
  Pedestrian pedestrian;
  base::Noise noise(seed, stream, 0);
  pedestrian.speed = std::clamp(group->speed + group->speed_deviation * noise.Gaussian(),
                                group->speed / 3, 2 * group->speed);
  pedestrian.leg =
      static_cast<std::uint32_t>(noise.Uniform() * static_cast<double>(group->route.size()));
  pedestrian.group = std::move(group);
  pedestrian.seed = seed;
  pedestrian.stream = stream;
  return pedestrian;
}

Vector2 GoalOf(const Pedestrian& pedestrian, std::uint32_t reached) {
  base::Noise noise(pedestrian.seed, pedestrian.stream, kFirstGoal + reached);
  return DrawWithin(GoalAt(pedestrian, std::uint64_t{pedestrian.leg} + 1 + reached), noise);
}

Vector2 StartOf(const Pedestrian& pedestrian, std::uint32_t attempt) {
  base::Noise noise(pedestrian.seed, pedestrian.stream, kFirstAttempt + attempt);
  const Vector2 from = DrawWithin(GoalAt(pedestrian, pedestrian.leg), noise);
  const Vector2 to = DrawWithin(GoalAt(pedestrian, std::uint64_t{pedestrian.leg} + 1), noise);
  const double part = noise.Uniform();
  return {from.x + part * (to.x - from.x), from.y + part * (to.y - from.y)};
}

}  // namespace gsv::world
