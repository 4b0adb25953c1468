#include "gsv/reality/odometry_comparison.h"

#include <algorithm>
#include <cmath>

#include "gsv/base/random.h"
#include "gsv/reality/statistics.h"

namespace gsv::reality {
namespace {

constexpr double kMaxStepTime = 1;  // s; no odometry is computed across a longer gap
constexpr double kTruthStep =
    0.5;  // s; long enough to average out the jitter of the reference system

// Returns the pose after moving along an arc.
TimedPose Advanced(const TimedPose& pose, double time, double way, double turn) {
  const double heading = pose.yaw + turn / 2;
  const double chord = std::abs(turn) < 1e-9 ? way : way * std::sin(turn / 2) / (turn / 2);
  return {time, pose.x + chord * std::cos(heading), pose.y + chord * std::sin(heading),
          pose.yaw + turn};
}

struct Relative {
  double ahead = 0, aside = 0, turn = 0;
};
Relative Between(const TimedPose& from, const TimedPose& to) {
  const double dx = to.x - from.x, dy = to.y - from.y;
  const double cosine = std::cos(from.yaw), sine = std::sin(from.yaw);
  return {cosine * dx + sine * dy, cosine * dy - sine * dx, WrappedAngle(to.yaw - from.yaw)};
}

// Returns one true pose for each half second.
std::vector<TimedPose> Thinned(const std::vector<TimedPose>& truth) {
  std::vector<TimedPose> thinned;
  for (const TimedPose& pose : truth) {
    if (thinned.empty() || pose.time - thinned.back().time >= kTruthStep) thinned.push_back(pose);
  }
  return thinned;
}

double Signed(const Relative& way) {
  return std::copysign(std::hypot(way.ahead, way.aside), way.ahead);
}

// Returns the slope a of y = a x by least squares.
double Slope(const std::vector<double>& x, const std::vector<double>& y) {
  double xy = 0, xx = 0;
  for (std::size_t i = 0; i < x.size(); ++i) xy += x[i] * y[i], xx += x[i] * x[i];
  return xx > 0 ? xy / xx : 1;
}

}  // namespace

std::vector<TimedPose> ReckonedPath(const Log& log, double wheel_distance, TimedPose start) {
  if (!log.odometry.empty()) return log.odometry;
  std::vector<TimedPose> path;
  for (std::size_t i = 0; i < log.wheels.size(); ++i) {
    start.time = log.wheels[i].time;
    if (i == 0) {
      path.push_back(start);
      continue;
    }
    const double left = log.wheels[i].left - log.wheels[i - 1].left;
    const double right = log.wheels[i].right - log.wheels[i - 1].right;
    path.push_back(
        Advanced(path.back(), start.time, (left + right) / 2, (right - left) / wheel_distance));
  }
  if (!path.empty()) return path;
  for (std::size_t i = 0; i < log.commands.size(); ++i) {
    start.time = log.commands[i].time;
    if (i == 0) {
      path.push_back(start);
      continue;
    }
    const TimedTwist& command = log.commands[i - 1];
    const double step = std::min(start.time - command.time, kMaxStepTime);
    path.push_back(
        Advanced(path.back(), start.time, command.linear * step, command.angular * step));
  }
  return path;
}

std::vector<MotionWindow> Windows(const std::vector<TimedPose>& reckoned,
                                  const std::vector<TimedPose>& truth, double seconds) {
  std::vector<MotionWindow> windows;
  if (truth.empty() || reckoned.empty()) return windows;
  const double end = std::min(truth.back().time, reckoned.back().time);
  double time = std::max(truth.front().time, reckoned.front().time);
  for (; time + seconds <= end; time += seconds) {
    const auto a = PoseAt(reckoned, time), b = PoseAt(reckoned, time + seconds);
    if (!a || !b) continue;
    MotionWindow window;
    std::optional<TimedPose> before = PoseAt(truth, time);
    const std::optional<TimedPose> first = before;
    double turn = 0, reckoned_turn = 0;
    std::optional<TimedPose> reckoned_before = a;
    const int parts = std::max(1, static_cast<int>(std::round(seconds / kTruthStep)));
    for (int i = 1; i <= parts && before && reckoned_before; ++i) {
      const double then = time + seconds * i / parts;
      const auto pose = PoseAt(truth, then), reckoned_pose = PoseAt(reckoned, then);
      if (pose && reckoned_pose) {
        const Relative step = Between(*before, *pose);
        window.metres += std::hypot(step.ahead, step.aside);
        window.radians += std::abs(step.turn);
        turn += step.turn;
        reckoned_turn += Between(*reckoned_before, *reckoned_pose).turn;
      }
      before = pose, reckoned_before = reckoned_pose;
    }
    if (!before || !reckoned_before) continue;
    window.true_way = Signed(Between(*first, *before));
    window.reckoned_way = Signed(Between(*a, *b));
    window.true_turn = turn;
    window.reckoned_turn = reckoned_turn;
    windows.push_back(window);
  }
  return windows;
}

MotionStatistics StatisticsOf(const std::vector<MotionWindow>& windows) {
  std::vector<double> ways, turns, true_ways, true_turns;
  for (const MotionWindow& window : windows) {
    ways.push_back(window.reckoned_way), true_ways.push_back(window.true_way);
    turns.push_back(window.reckoned_turn), true_turns.push_back(window.true_turn);
  }
  MotionStatistics statistics;
  statistics.way_ratio = Slope(ways, true_ways);
  statistics.turn_ratio = Slope(turns, true_turns);
  for (std::size_t i = 0; i < windows.size(); ++i) {
    statistics.way_residuals.push_back(true_ways[i] - statistics.way_ratio * ways[i]);
    statistics.turn_residuals.push_back(true_turns[i] - statistics.turn_ratio * turns[i]);
  }
  statistics.way_scatter = Summarize(statistics.way_residuals).deviation;
  statistics.turn_scatter = Summarize(statistics.turn_residuals).deviation;
  return statistics;
}

std::vector<TimedPose> SimulatedOdometry(const std::vector<TimedPose>& truth,
                                         const sensing::OdometryDrift& drift, std::uint64_t seed) {
  const std::vector<TimedPose> way = Thinned(truth);
  std::vector<TimedPose> path;
  for (std::size_t i = 0; i < way.size(); ++i) {
    if (i == 0) {
      path.push_back(way[i]);
      continue;
    }
    const Relative step = Between(way[i - 1], way[i]);
    base::Noise noise(seed, base::StableId("robot/odometry/drift"), i);
    const double first = noise.Gaussian(), second = noise.Gaussian(), third = noise.Gaussian();
    const sensing::OdometryStep drifted =
        sensing::Drifted(drift, {Signed(step), step.turn}, first, second, third);
    path.push_back(Advanced(path.back(), way[i].time, drifted.way, drifted.turn));
  }
  return path;
}

sensing::OdometryDrift FitDrift(const std::vector<MotionWindow>& windows) {
  // The estimate has errors, and the true motion is treated as exact. Therefore the regression of
  // the estimate on the truth has no bias, unlike the inverse of MotionStatistics::way_ratio.
  std::vector<double> ways, turns, true_ways, true_turns;
  for (const MotionWindow& window : windows) {
    ways.push_back(window.reckoned_way), true_ways.push_back(window.true_way);
    turns.push_back(window.reckoned_turn), true_turns.push_back(window.true_turn);
  }
  sensing::OdometryDrift drift;
  drift.linear_scale = std::max(Slope(true_ways, ways), 0.01);
  drift.angular_scale = std::max(Slope(true_turns, turns), 0.01);
  double metres = 0, way_squares = 0;
  // The sums of the normal equations of a least-squares fit of a and b:
  // squared error of the rotation = a * metres + b * radians.
  double mm = 0, mr = 0, rr = 0, ms = 0, rs = 0;
  for (std::size_t i = 0; i < windows.size(); ++i) {
    const MotionWindow& w = windows[i];
    const double way = ways[i] - drift.linear_scale * true_ways[i];
    const double turn = std::pow(turns[i] - drift.angular_scale * true_turns[i], 2);
    metres += w.metres, way_squares += way * way;
    mm += w.metres * w.metres, mr += w.metres * w.radians, rr += w.radians * w.radians;
    ms += w.metres * turn, rs += w.radians * turn;
  }
  if (metres > 0) drift.linear_per_metre = std::sqrt(way_squares / metres);
  const double determinant = mm * rr - mr * mr;
  double per_metre = 0, per_radian = 0;
  if (determinant > 1e-12) {
    per_metre = (ms * rr - rs * mr) / determinant;
    per_radian = (rs * mm - ms * mr) / determinant;
  }
  if (per_metre < 0 && rr > 0) per_metre = 0, per_radian = rs / rr;
  if (per_radian < 0 && mm > 0) per_radian = 0, per_metre = ms / mm;
  drift.angular_per_metre = std::sqrt(std::max(0.0, per_metre));
  drift.angular_per_radian = std::sqrt(std::max(0.0, per_radian));
  return drift;
}

}  // namespace gsv::reality
