#include "gsv/dynamics/people/script_pose.h"

#include <algorithm>
#include <cmath>

namespace gsv::dynamics {
namespace {

using base::SimTime;
using geometry::Quaternion;
using geometry::Vector3;
using model::Trajectory;
using model::Waypoint;

Vector3 TangentAt(const Trajectory& trajectory, std::size_t i) {
  const std::vector<Waypoint>& points = trajectory.waypoints;
  const std::size_t last = points.size() - 1;
  const bool is_closed = points.front().pose.position == points.back().pose.position;
  std::size_t before = i == 0 ? 0 : i - 1;
  std::size_t after = i == last ? last : i + 1;
  if (is_closed && (i == 0 || i == last)) before = last - 1, after = 1;
  return (points[after].pose.position - points[before].pose.position) *
         (0.5 * (1 - trajectory.tension));
}

Quaternion Slerp(const Quaternion& from, Quaternion to, double part) {
  double cosine = from.w * to.w + from.x * to.x + from.y * to.y + from.z * to.z;
  if (cosine < 0) {
    to = {-to.w, -to.x, -to.y, -to.z};
    cosine = -cosine;
  }
  double a = 1 - part, b = part;
  if (cosine < 1 - 1e-9) {
    const double angle = std::acos(cosine), sine = std::sin(angle);
    a = std::sin(a * angle) / sine;
    b = std::sin(b * angle) / sine;
  }
  return Normalized(Quaternion{a * from.w + b * to.w, a * from.x + b * to.x, a * from.y + b * to.y,
                               a * from.z + b * to.z});
}

SimTime LengthOf(const Trajectory& trajectory) { return trajectory.waypoints.back().time; }

// The instant at the time `running` after the script's start. `running` is less than the script's
// length.
ScriptInstant WithinScript(const model::Script& script, SimTime running) {
  ScriptInstant instant;
  while (instant.trajectory + 1 < script.trajectories.size() &&
         running >= LengthOf(script.trajectories[instant.trajectory])) {
    running -= LengthOf(script.trajectories[instant.trajectory]);
    ++instant.trajectory;
  }
  instant.since = running;
  if (!script.trajectories.empty()) {
    instant.pose = PoseOn(script.trajectories[instant.trajectory], running);
  }
  return instant;
}

}  // namespace

geometry::Pose PoseOn(const Trajectory& trajectory, SimTime time) {
  const std::vector<Waypoint>& points = trajectory.waypoints;
  const auto next =
      std::upper_bound(points.begin(), points.end(), time,
                       [](SimTime t, const Waypoint& waypoint) { return t < waypoint.time; });
  if (next == points.begin()) return points.front().pose;
  if (next == points.end()) return points.back().pose;
  const auto i = static_cast<std::size_t>(next - points.begin()) - 1;
  const Waypoint &a = points[i], &b = points[i + 1];
  const double u = base::ToSeconds(time - a.time) / base::ToSeconds(b.time - a.time);
  const double u2 = u * u, u3 = u2 * u;
  return {a.pose.position * (2 * u3 - 3 * u2 + 1) + b.pose.position * (3 * u2 - 2 * u3) +
              TangentAt(trajectory, i) * (u3 - 2 * u2 + u) +
              TangentAt(trajectory, i + 1) * (u3 - u2),
          Slerp(a.pose.orientation, b.pose.orientation, u)};
}

ScriptInstant InstantOf(const model::Script& script, SimTime time) {
  SimTime length{0};
  for (const Trajectory& trajectory : script.trajectories) length += LengthOf(trajectory);
  // The script has no duration, but `since` still grows, because an animation without a trajectory
  // needs the time.
  if (length.count() == 0) {
    ScriptInstant instant = WithinScript(script, SimTime{0});
    if (script.starts_by_itself) instant.since = std::max(SimTime{0}, time - script.delay);
    return instant;
  }
  if (!script.starts_by_itself) return WithinScript(script, SimTime{0});
  const SimTime cycle_length = script.delay + length;
  const std::int64_t cycle = script.loops ? time / cycle_length : 0;
  const SimTime running = time - cycle * cycle_length - script.delay;
  const bool waits_again = running.count() < 0 && cycle > 0;
  ScriptInstant instant =
      WithinScript(script, waits_again ? length : std::clamp(running, SimTime{0}, length));
  instant.cycle = waits_again ? cycle - 1 : cycle;
  return instant;
}

}  // namespace gsv::dynamics
