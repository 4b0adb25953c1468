#include "gsv/gateway/curves/curve_points.h"

#include <algorithm>
#include <cmath>

#include "gsv/base/sorting.h"

namespace gsv::gateway::curves {

CurvePoints::CurvePoints(base::SimTime start, base::SimTime end, std::size_t max_points)
    : start_(start),
      end_(std::max(start, end)),
      max_points_(std::max<std::size_t>(2, max_points)) {}

void CurvePoints::Add(base::SimTime time, double value) {
  ++samples_;
  if (!bins_.empty()) return AddToBin({time, value});
  points_.push_back({time, value});
  if (points_.size() <= max_points_) return;
  bins_.resize(max_points_ / 2);
  for (const Point& point : points_) AddToBin(point);
  points_.clear();
  points_.shrink_to_fit();
}

void CurvePoints::AddToBin(const Point& point) {
  const double span = base::ToSeconds(end_ - start_);
  const double share =
      span > 0 ? base::ToSeconds(std::clamp(point.time, start_, end_) - start_) / span : 0;
  const auto index = static_cast<std::size_t>(share * static_cast<double>(bins_.size()));
  TimeBin& bin = bins_[std::min(index, bins_.size() - 1)];
  const bool is_first = bin.samples++ == 0;
  const bool is_finite = std::isfinite(point.value);
  if (is_first || (is_finite && bin.finite == 0)) {
    bin.min = bin.max = point;
  } else if (is_finite) {
    if (point.value < bin.min.value) bin.min = point;
    if (point.value > bin.max.value) bin.max = point;
  }
  if (is_finite) ++bin.finite;
}

std::vector<Point> CurvePoints::Points() const {
  std::vector<Point> points = points_;
  for (const TimeBin& bin : bins_) {
    if (bin.samples == 0) continue;
    points.push_back(bin.min);
    if (bin.max.time != bin.min.time) points.push_back(bin.max);
  }
  base::Sort(points, [](const Point& a, const Point& b) { return a.time < b.time; });
  return points;
}

}  // namespace gsv::gateway::curves
