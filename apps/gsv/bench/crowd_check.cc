#include "apps/gsv/bench/crowd_check.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <fmt/format.h>

#include "apps/gsv/scenes/crowd_scenario.h"
#include "gsv/base/random.h"

namespace gsv::app {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();
constexpr double kReadingTolerance = 1e-9;  // in m
// The mover allows bodies to touch. Because of rounding, the computed overlap of two touching
// bodies may be this large.
constexpr double kOverlapTolerance = 1e-6;  // in m
constexpr std::uint64_t kOneIn = 100;

struct Point {
  double x, y;
};

// Converts a point in the world to the frame of an upright box.
Point InBox(const geometry::Pose& box, Point p) {
  const double yaw = geometry::Yaw(box.orientation), c = std::cos(yaw), s = std::sin(yaw);
  const double x = p.x - box.position.x, y = p.y - box.position.y;
  return {c * x + s * y, -s * x + c * y};
}

const geometry::Vector3& BoxSize(const world::Body& body) {
  return std::get<geometry::Box>(body.model->links[0].collisions[0].shape).size;
}

// Returns the distance at which a ray in the plane (unit direction) enters a disc, or leaves it if
// the ray starts inside.
double RayToDisc(Point from, Point along, Point centre, double radius) {
  const double x = centre.x - from.x, y = centre.y - from.y;
  const double b = x * along.x + y * along.y;
  const double discriminant = b * b - (x * x + y * y - radius * radius);
  if (discriminant < 0) return kInfinite;
  const double root = std::sqrt(discriminant);
  if (b - root >= 0) return b - root;
  return b + root >= 0 ? b + root : kInfinite;
}

double RayToBox(Point from, Point along, const geometry::Pose& pose,
                const geometry::Vector3& size) {
  const Point start = InBox(pose, from);
  const Point end = InBox(pose, {from.x + along.x, from.y + along.y});
  const double origin[2]{start.x, start.y}, direction[2]{end.x - start.x, end.y - start.y};
  const double half[2]{size.x / 2, size.y / 2};
  double enter = -kInfinite, leave = kInfinite;
  for (int axis = 0; axis < 2; ++axis) {
    if (direction[axis] == 0) {
      if (std::abs(origin[axis]) > half[axis]) return kInfinite;
      continue;
    }
    const double a = (-half[axis] - origin[axis]) / direction[axis];
    const double b = (half[axis] - origin[axis]) / direction[axis];
    enter = std::max(enter, std::min(a, b));
    leave = std::min(leave, std::max(a, b));
  }
  if (leave < std::max(enter, 0.0)) return kInfinite;
  return enter >= 0 ? enter : leave;
}

// Returns the penetration depth of a robot's disc in a box. If the result is negative, its absolute
// value is the distance between the disc and the box.
double DepthInBox(Point centre, const geometry::Pose& pose, const geometry::Vector3& size) {
  const Point p = InBox(pose, centre);
  const double out_x = std::abs(p.x) - size.x / 2, out_y = std::abs(p.y) - size.y / 2;
  const double gap = std::hypot(std::max(out_x, 0.0), std::max(out_y, 0.0));
  return gap > 0 ? kCrowdRobotRadius - gap : kCrowdRobotRadius - std::max(out_x, out_y);
}

Point PlaceOf(const world::Snapshot& snapshot, std::size_t body) {
  const geometry::Vector3& p = snapshot.state.bodies[body].world_from_model.position;
  return {p.x, p.y};
}

double NearestByBruteForce(const world::Snapshot& snapshot, std::size_t robot, Point along) {
  const Point from = PlaceOf(snapshot, robot);
  double nearest = kInfinite;
  for (std::size_t i = 0; i < snapshot.layout->bodies.size(); ++i) {
    const world::Body& body = snapshot.layout->bodies[i];
    if (i == robot) continue;
    const double distance =
        body.is_static()
            ? RayToBox(from, along, snapshot.state.bodies[i].world_from_model, BoxSize(body))
            : RayToDisc(from, along, PlaceOf(snapshot, i), kCrowdRobotRadius);
    nearest = std::min(nearest, distance);
  }
  return std::min(nearest, kCrowdRange);
}

}  // namespace

void CrowdCheck::TakeReadings(const world::Snapshot& snapshot, const std::string& robot,
                              const std::vector<double>& readings) {
  const int body = snapshot.layout->Find(robot);
  base::Noise choice(7, base::StableId(robot), static_cast<std::uint64_t>(snapshot.state.step));
  for (std::size_t ray = 0; ray < readings.size(); ++ray) {
    if (choice.Uniform() * kOneIn >= 1) continue;
    const auto index = static_cast<std::size_t>(body);
    const double bearing =
        geometry::Yaw(snapshot.state.bodies[index].world_from_model.orientation) +
        2 * std::numbers::pi * static_cast<double>(ray) / kCrowdRays;
    const double expected =
        NearestByBruteForce(snapshot, index, {std::cos(bearing), std::sin(bearing)});
    ++readings_checked_;
    if (std::abs(expected - readings[ray]) <= kReadingTolerance) continue;
    Report(fmt::format("step {}, {}, ray {}: the sensor reads {} m, brute force gives {} m",
                       snapshot.state.step, robot, ray, readings[ray], expected));
  }
}

void CrowdCheck::OnSnapshot(const std::shared_ptr<const world::Snapshot>& snapshot) {
  const std::vector<world::Body>& bodies = snapshot->layout->bodies;
  std::uint64_t pairs = 0;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (bodies[i].is_static()) continue;
    const Point here = PlaceOf(*snapshot, i);
    for (std::size_t k = 0; k < bodies.size(); ++k) {
      if (k == i || (!bodies[k].is_static() && k < i)) continue;
      ++pairs;
      const Point there = PlaceOf(*snapshot, k);
      const double depth =
          bodies[k].is_static()
              ? DepthInBox(here, snapshot->state.bodies[k].world_from_model, BoxSize(bodies[k]))
              : 2 * kCrowdRobotRadius - std::hypot(there.x - here.x, there.y - here.y);
      if (depth <= kOverlapTolerance) continue;
      Report(fmt::format("step {}: {} reaches {} m into {}", snapshot->state.step, bodies[i].name,
                         depth, bodies[k].name));
    }
  }
  pairs_checked_ += pairs;
}

void CrowdCheck::Report(std::string sentence) {
  ++mismatches_;
  const base::MutexLock lock(mutex_);
  if (first_mismatch_.empty()) first_mismatch_ = std::move(sentence);
}

std::string CrowdCheck::first_mismatch() const {
  const base::MutexLock lock(mutex_);
  return first_mismatch_;
}

}  // namespace gsv::app
