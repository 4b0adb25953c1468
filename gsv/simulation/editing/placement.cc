#include "gsv/simulation/editing/placement.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

namespace gsv::simulation {
namespace {

constexpr double kPlacingTolerance = 1e-3;  // m; a smaller overlap is accepted

// Returns the index of a body that `body` overlaps, or -1.
int FindOverlap(dynamics::Engine& engine, const world::Layout& layout, const world::State& state,
                int body) {
  int found = -1;
  for (const world::Contact& overlap : engine.OverlapsOf(state, body, kPlacingTolerance)) {
    found = overlap.first == body ? overlap.second : overlap.first;
    // Prefer a robot for the error message, because robots are harder to move out of the way.
    if (layout.bodies[static_cast<std::size_t>(found)].is_robot()) return found;
  }
  return found;
}

// Tries places in 16 directions around the body, up to its own radius away, the nearest first. Moves
// it to the first one that is free with some margin. Returns false if none is.
bool PushOut(dynamics::Engine& engine, const world::Layout& layout, int body, world::State& state) {
  constexpr double kStride = 0.01;  // distance between two tried places, m
  constexpr int kDirections = 16;
  const world::Body& robot = layout.bodies[static_cast<std::size_t>(body)];
  const double farthest = model::FootprintRadius(*robot.model);
  const auto is_free_at = [&](double distance, double direction) {
    geometry::Pose& pose = state.bodies[static_cast<std::size_t>(body)].world_from_model;
    pose = robot.initial_pose;
    pose.position.x += distance * std::cos(direction);
    pose.position.y += distance * std::sin(direction);
    return FindOverlap(engine, layout, state, body) < 0;
  };
  for (double distance = kStride; distance <= farthest; distance += kStride) {
    for (int i = 0; i < kDirections; ++i) {
      const double direction = 2 * std::numbers::pi * i / kDirections;
      // The place two strides farther must also be free, so that the body can turn beside the wall.
      if (is_free_at(distance, direction) && is_free_at(distance + 2 * kStride, direction)) {
        return true;
      }
    }
  }
  return false;
}

// Returns, for each body, whether it overlaps no other body. One such call is faster than one call
// of FindOverlap() for each robot. The result stays valid for robots that are free, because
// PushOut() moves other robots only to free places.
std::vector<bool> StandFree(dynamics::Engine& engine, const world::Layout& layout,
                            const world::State& state) {
  std::vector<bool> stand_free(layout.bodies.size(), true);
  for (const world::Contact& overlap : engine.Overlaps(state, kPlacingTolerance)) {
    stand_free[static_cast<std::size_t>(overlap.first)] = false;
    stand_free[static_cast<std::size_t>(overlap.second)] = false;
  }
  return stand_free;
}

}  // namespace

std::string PlaceText(const geometry::Pose& pose) {
  const auto rounded = [](double metres) { return std::round(metres * 1000) / 1000 + 0.0; };
  char text[64];
  std::snprintf(text, sizeof text, "(%g, %g)", rounded(pose.position.x), rounded(pose.position.y));
  return text;
}

base::Result<std::vector<PushedOut>> ResolvePlacement(dynamics::Engine& engine,
                                                      const world::Layout& layout,
                                                      const std::vector<std::string>& placed,
                                                      world::State& state) {
  std::vector<PushedOut> pushed_out;
  if (placed.empty()) return pushed_out;
  const std::vector<bool> stand_free = StandFree(engine, layout, state);
  for (auto name = placed.begin(); name != placed.end(); ++name) {
    const int index = layout.Find(*name);
    const world::Body& body = layout.bodies[static_cast<std::size_t>(index)];
    if (body.is_robot() && stand_free[static_cast<std::size_t>(index)]) continue;
    const int overlapped = FindOverlap(engine, layout, state, index);
    if (overlapped < 0) continue;
    const world::Body& other = layout.bodies[static_cast<std::size_t>(overlapped)];
    // If the other body comes later in `placed`, this body is kept. The other body is pushed out or
    // refused in a later iteration.
    if (std::find(name + 1, placed.end(), other.name) != placed.end()) continue;
    const std::string wanted = PlaceText(body.initial_pose);
    // A robot that overlaps a wall or an object is moved beside it. PushOut() searches only within
    // the robot's radius. So it finds a place only if a large part of the robot is outside the
    // wall.
    if (body.is_robot() && !other.is_robot() && PushOut(engine, layout, index, state)) {
      const geometry::Pose& now = state.bodies[static_cast<std::size_t>(index)].world_from_model;
      pushed_out.push_back({*name, "starts at " + PlaceText(now) + ", since at " + wanted +
                                       " it would overlap \"" + other.name + "\""});
      continue;
    }
    return base::Fail(base::ErrorCode::kBadModel,
                      "there is no room at " + wanted + ": it would overlap \"" + other.name +
                          "\"; choose another place",
                      *name);
  }
  return pushed_out;
}

}  // namespace gsv::simulation
