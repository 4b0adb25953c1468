#include "gsv/reality/localization.h"

#include <algorithm>
#include <cmath>
#include <queue>

#include "gsv/base/sorting.h"
#include "gsv/geometry/constants.h"

namespace gsv::reality {
namespace {

using geometry::kPi;

constexpr float kFarthest = 1;  // m; larger distances are set to this

TimedPose Composed(const TimedPose& a, const TimedPose& b) {
  const double cosine = std::cos(a.yaw), sine = std::sin(a.yaw);
  return {b.time, a.x + cosine * b.x - sine * b.y, a.y + sine * b.x + cosine * b.y,
          WrappedAngle(a.yaw + b.yaw)};
}

TimedPose Inverted(const TimedPose& a) {
  const double cosine = std::cos(a.yaw), sine = std::sin(a.yaw);
  return {a.time, -cosine * a.x - sine * a.y, sine * a.x - cosine * a.y, -a.yaw};
}

}  // namespace

LikelihoodField::LikelihoodField(const OccupancyMap& map)
    : map_(map), deviation_(std::max(0.02, map.resolution)) {
  distances_.assign(map.cells.size(), kFarthest);
  // Computes the distances with Dijkstra's algorithm. Its steps go to the eight neighbours of a
  // cell, so the distances are at most 8 % too long.
  using Entry = std::pair<float, std::size_t>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  for (std::size_t i = 0; i < map.cells.size(); ++i) {
    if (map.cells[i] != Cell::kOccupied) continue;
    distances_[i] = 0;
    open.emplace(0.0f, i);
  }
  const auto side = static_cast<float>(map.resolution);
  while (!open.empty()) {
    const auto [distance, place] = open.top();
    open.pop();
    if (distance > distances_[place]) continue;
    const int x = static_cast<int>(place % static_cast<std::size_t>(map.width));
    const int y = static_cast<int>(place / static_cast<std::size_t>(map.width));
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dx = -1; dx <= 1; ++dx) {
        const int nx = x + dx, ny = y + dy;
        if (nx < 0 || ny < 0 || nx >= map.width || ny >= map.height) continue;
        const float next = distance + side * (dx != 0 && dy != 0 ? 1.41421356f : 1.0f);
        const auto there = static_cast<std::size_t>(ny) * static_cast<std::size_t>(map.width) +
                           static_cast<std::size_t>(nx);
        if (next < distances_[there]) {
          distances_[there] = next;
          open.emplace(next, there);
        }
      }
    }
  }
}

double LikelihoodField::DistanceAt(double x, double y) const {
  const double cell_x = (x - map_.origin_x) / map_.resolution;
  const double cell_y = (y - map_.origin_y) / map_.resolution;
  if (!(cell_x >= 0 && cell_y >= 0 && cell_x < map_.width && cell_y < map_.height)) {
    return kFarthest;
  }
  return distances_[static_cast<std::size_t>(cell_y) * static_cast<std::size_t>(map_.width) +
                    static_cast<std::size_t>(cell_x)];
}

double LikelihoodField::Score(const Log& log, const RangeScan& scan, const TimedPose& base,
                              std::size_t stride) const {
  const double x = base.x + log.sensor_forward * std::cos(base.yaw);
  const double y = base.y + log.sensor_forward * std::sin(base.yaw);
  double sum = 0;
  int count = 0;
  for (std::size_t i = 0; i < scan.ranges.size(); i += stride) {
    const double range = scan.ranges[i];
    if (!std::isfinite(range)) continue;
    const double angle = base.yaw + log.beam_angles[i];
    const double off = DistanceAt(x + range * std::cos(angle), y + range * std::sin(angle));
    sum += std::exp(-off * off / (2 * deviation_ * deviation_));
    ++count;
  }
  return count > 0 ? sum / count : 0;
}

TimedPose LikelihoodField::Refined(const Log& log, const RangeScan& scan, TimedPose guess,
                                   double reach) const {
  double best = Score(log, scan, guess, 3);
  for (double step = reach; step > deviation_ / 20; step /= 2) {
    for (bool is_better = true; is_better;) {
      is_better = false;
      const TimedPose from = guess;
      const double tries[6][3] = {{step, 0, 0},  {-step, 0, 0},    {0, step, 0},
                                  {0, -step, 0}, {0, 0, step / 2}, {0, 0, -step / 2}};
      for (const auto& way : tries) {
        const TimedPose there{from.time, from.x + way[0], from.y + way[1], from.yaw + way[2]};
        const double score = Score(log, scan, there, 3);
        if (score > best + 1e-9) best = score, guess = there, is_better = true;
      }
    }
  }
  return guess;
}

namespace {

struct Candidate {
  double score = 0;
  TimedPose pose;
};

// Finds the pose of the first scan. Rates the poses of a coarse grid by the first scan. Then rates
// the best of them by a few scans along the first metres of the path, and returns the best one.
std::optional<TimedPose> FindStart(const Log& log, const LikelihoodField& field) {
  constexpr double kApart = 1;  // minimum distance between two of these scans, m
  constexpr std::size_t kScans = 6, kKept = 300;
  const TimedPose home = Inverted(*log.scans.front().base);
  std::vector<std::pair<const RangeScan*, TimedPose>> views;  // first_from_base
  for (const RangeScan& scan : log.scans) {
    if (!scan.base) continue;
    const TimedPose moved = Composed(home, *scan.base);
    const bool is_new = views.empty() || std::hypot(moved.x - views.back().second.x,
                                                    moved.y - views.back().second.y) > kApart;
    if (is_new) views.emplace_back(&scan, moved);
    if (views.size() == kScans) break;
  }
  const OccupancyMap& map = field.map();
  std::vector<Candidate> best;
  const int cells = std::max(1, static_cast<int>(0.3 / map.resolution));
  for (int y = 0; y < map.height; y += cells) {
    for (int x = 0; x < map.width; x += cells) {
      if (map.at(x, y) != Cell::kFree) continue;
      for (int turn = 0; turn < 72; ++turn) {
        const TimedPose pose{0, map.origin_x + (x + 0.5) * map.resolution,
                             map.origin_y + (y + 0.5) * map.resolution, turn * kPi / 36 - kPi};
        const double score = field.Score(log, *views[0].first, pose, 9);
        if (best.size() >= 20 * kKept && score <= best.back().score) continue;
        best.push_back({score, pose});
        if (best.size() < 40 * kKept) continue;
        base::Sort(best, [](const Candidate& a, const Candidate& b) { return a.score > b.score; });
        best.resize(20 * kKept);
      }
    }
  }
  base::Sort(best, [](const Candidate& a, const Candidate& b) { return a.score > b.score; });
  best.resize(std::min(best.size(), 10 * kKept));
  // Follows the odometry from scan to scan. Each search starts at the pose of the previous scan,
  // moved by the odometry since then.
  for (Candidate& candidate : best) {
    TimedPose pose = field.Refined(log, *views[0].first, candidate.pose, 0.16);
    candidate.pose = pose;
    candidate.score = field.Score(log, *views[0].first, pose, 3);
    for (std::size_t i = 1; i < views.size(); ++i) {
      pose = Composed(pose, Composed(Inverted(views[i - 1].second), views[i].second));
      pose = field.Refined(log, *views[i].first, pose, 0.16);
      candidate.score += field.Score(log, *views[i].first, pose, 3);
    }
  }
  const auto winner =
      std::max_element(best.begin(), best.end(),
                       [](const Candidate& a, const Candidate& b) { return a.score < b.score; });
  if (winner == best.end()) return std::nullopt;
  return winner->pose;
}

}  // namespace

base::Result<std::vector<TimedPose>> Localize(const Log& log, const LikelihoodField& field,
                                              const std::optional<TimedPose>& start,
                                              std::size_t stride) {
  constexpr double kMinScore = 0.3;
  if (log.scans.empty() || !log.scans.front().base) {
    return base::Fail(base::ErrorCode::kInvalidArgument, "the log has no scans with odometry");
  }
  std::optional<TimedPose> pose = start ? start : FindStart(log, field);
  std::vector<TimedPose> poses;
  TimedPose last_odometry = *log.scans.front().base;
  double scores = 0;
  for (std::size_t i = 0; pose && i < log.scans.size(); i += stride) {
    const RangeScan& scan = log.scans[i];
    if (scan.base) {
      *pose = Composed(*pose, Composed(Inverted(last_odometry), *scan.base));
      last_odometry = *scan.base;
    }
    *pose = field.Refined(log, scan, *pose, 0.08);
    pose->time = scan.time;
    poses.push_back(*pose);
    scores += field.Score(log, scan, *pose, 3);
  }
  if (poses.empty() || scores < kMinScore * static_cast<double>(poses.size())) {
    return base::Fail(base::ErrorCode::kInvalidArgument,
                      "no path through the world explains the scans; give the first pose in the "
                      "world with --start, or another world");
  }
  return poses;
}

}  // namespace gsv::reality
