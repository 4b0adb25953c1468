#include "gsv/dynamics/shapes/time_of_impact.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace gsv::dynamics {
namespace {

constexpr double kFloorGap = 0.25e-6;  // minimum gap that remains after rounding errors, m
constexpr int kMaxAdvances = 64;       // the pieces are stopped after this number of advances
constexpr double kApproach = 1e-9;     // m/s; a slower approach counts as sliding
constexpr double kNoise = 1e-12;       // m/s; a smaller speed is a rounding error

// The corners of a piece along an axis: their positions, their speeds, and bounds of their
// accelerations.
struct MovingCorners {
  std::array<double, ConvexPiece::kMaxVertices> along, speed, acceleration;
  int count = 0;
};

void Project(const ConvexPiece& placed, const geometry::PlanarPosition& at,
             const geometry::Twist& twist, Vector2 axis, MovingCorners& corners) {
  corners.count = placed.vertex_count;
  const double vx = at.cosine * twist.x - at.sine * twist.y;
  const double vy = at.sine * twist.x + at.cosine * twist.y;
  for (int i = 0; i < placed.vertex_count; ++i) {
    const Vector2 v = placed.vertices[i];
    const Vector2 speed{vx - twist.angular * (v.y - at.y), vy + twist.angular * (v.x - at.x)};
    corners.along[i] = Dot(v, axis);
    corners.speed[i] = Dot(speed, axis);
    corners.acceleration[i] =
        twist.angular == 0 ? 0 : std::abs(twist.angular) * std::sqrt(Dot(speed, speed));
  }
}

void ProjectStanding(const ConvexPiece& placed, Vector2 axis, MovingCorners& corners) {
  corners.count = 1;
  corners.along[0] = std::numeric_limits<double>::infinity();
  for (const Vector2 v : placed.points())
    corners.along[0] = std::min(corners.along[0], Dot(v, axis));
  corners.speed[0] = corners.acceleration[0] = 0;
}

double Gap(const MovingCorners& a, const MovingCorners& b) {
  return *std::min_element(b.along.begin(), b.along.begin() + b.count) -
         *std::max_element(a.along.begin(), a.along.begin() + a.count);
}

// Returns the time after which this speed and acceleration close `gap`.
double TimeToClose(double gap, double speed, double acceleration) {
  const double root = std::sqrt(speed * speed + 2 * acceleration * gap);
  if (speed > 0) return 2 * gap / (speed + root);
  return acceleration > 0 ? (root - speed) / acceleration : std::numeric_limits<double>::infinity();
}

// A lower bound of the time at which a corner of one piece comes within `keep` of a corner of the
// other, along the axis. For that pair of corners: the gap (less `keep`) and the speed.
struct FirstMeeting {
  double time;
  double gap = 0;    // at the present time, m
  double speed = 0;  // at which the gap closes at the present time, m/s
};

FirstMeeting MeetAtTheEarliest(const MovingCorners& a, const MovingCorners& b, double keep,
                               double end) {
  FirstMeeting first{end};
  for (int i = 0; i < a.count; ++i) {
    for (int k = 0; k < b.count; ++k) {
      const double gap = b.along[k] - a.along[i] - keep;
      double speed = a.speed[i] - b.speed[k];
      if (speed > 0 && speed < kNoise) speed = 0;
      const double acceleration = a.acceleration[i] + b.acceleration[k];
      if ((speed + 0.5 * acceleration * first.time) * first.time <= gap) continue;
      const double time = TimeToClose(std::max(gap, 0.0), speed, acceleration);
      if (time < first.time) first = {time, gap, speed};
    }
  }
  return first;
}

double FastestNearTop(const MovingCorners& a) {
  const double top = *std::max_element(a.along.begin(), a.along.begin() + a.count);
  double fastest = -std::numeric_limits<double>::infinity();
  for (int i = 0; i < a.count; ++i) {
    if (a.along[i] >= top - kTouchGap) fastest = std::max(fastest, a.speed[i]);
  }
  return fastest;
}

double SlowestNearBottom(const MovingCorners& b) {
  const double bottom = *std::min_element(b.along.begin(), b.along.begin() + b.count);
  double slowest = std::numeric_limits<double>::infinity();
  for (int i = 0; i < b.count; ++i) {
    if (b.along[i] <= bottom + kTouchGap) slowest = std::min(slowest, b.speed[i]);
  }
  return slowest;
}

Impact MakeImpact(double time, Vector2 normal, const MovingCorners& a, const MovingCorners& b) {
  Impact impact{time, normal, FastestNearTop(a) > kApproach, SlowestNearBottom(b) < -kApproach};
  if (!impact.first_approaches && !impact.second_approaches) {
    impact.first_approaches = impact.second_approaches = true;
  }
  return impact;
}

// Whether no point of the piece moves.
bool IsStill(const MovingPiece& moving) {
  const geometry::Twist& twist = moving.twist;
  if (twist.x != 0 || twist.y != 0) return false;
  const ConvexPiece& piece = *moving.piece;
  return twist.angular == 0 || (piece.vertex_count == 1 && piece.vertices[0] == Vector2{});
}

// Finds the first contact, for a second piece that moves in any way. `place_second(t)` moves the
// second piece to its pose at time t. `project_second(axis, corners)` projects the piece, at that
// pose, on the axis. `normal` is the direction between the pieces at the start.
template <typename PlaceSecond, typename ProjectSecond>
std::optional<Impact> Find(const MovingPiece& first, double end, Vector2 normal,
                           PlaceSecond place_second, ProjectSecond project_second) {
  double time = 0;
  ConvexPiece placed;
  MovingCorners a, b;
  for (int advance = 0; advance < kMaxAdvances; ++advance) {
    const geometry::PlanarPosition at =
        advance == 0 ? first.start : Advance(first.start, first.twist, time);
    Place(*first.piece, at, placed);
    const ConvexPiece& second = place_second(time);
    if (advance > 0) normal = Separate(placed, second).normal;
    Project(placed, at, first.twist, normal, a);
    project_second(normal, b);
    const double radii = placed.radius + second.radius;
    const double gap = Gap(a, b) - radii;
    const bool touching = gap <= kTouchGap;
    const double keep = touching ? std::min(gap, kFloorGap) : kStopGap;
    const FirstMeeting meeting = MeetAtTheEarliest(a, b, radii + keep, end - time);
    if (meeting.time >= end - time) return std::nullopt;
    if (touching && meeting.speed > 0 && meeting.gap <= kTouchGap) {
      return MakeImpact(time, normal, a, b);
    }
    time += meeting.time;
  }
  return MakeImpact(time, normal, a, b);
}

}  // namespace

std::optional<Impact> FindImpact(const MovingPiece& first, const MovingPiece& second, double end,
                                 Vector2 normal) {
  if (IsStill(first) && IsStill(second)) return std::nullopt;
  ConvexPiece placed;
  geometry::PlanarPosition at;
  return Find(
      first, end, normal,
      [&](double time) -> const ConvexPiece& {
        at = time == 0 ? second.start : Advance(second.start, second.twist, time);
        Place(*second.piece, at, placed);
        return placed;
      },
      [&](Vector2 axis, MovingCorners& corners) {
        Project(placed, at, second.twist, axis, corners);
      });
}

std::optional<Impact> FindImpact(const MovingPiece& first, const ConvexPiece& standing, double end,
                                 Vector2 normal) {
  if (IsStill(first)) return std::nullopt;
  return Find(
      first, end, normal, [&](double) -> const ConvexPiece& { return standing; },
      [&](Vector2 axis, MovingCorners& corners) { ProjectStanding(standing, axis, corners); });
}

}  // namespace gsv::dynamics
