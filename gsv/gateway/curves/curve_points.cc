#include "gsv/gateway/curves/curve_points.h"

#include <algorithm>
#include <cmath>

namespace gsv::gateway::curves {

CurvePoints::CurvePoints(base::SimTime start, base::SimTime end, std::size_t most)
    : start_(start), end_(std::max(start, end)), most_(std::max<std::size_t>(2, most)) {}

void CurvePoints::Add(base::SimTime time, double value) {
  ++samples_;
  if (!stretches_.empty()) return AddToStretch({time, value});
  points_.push_back({time, value});
  if (points_.size() <= most_) return;
  stretches_.resize(most_ / 2);
  for (const Point& point : points_) AddToStretch(point);
  points_.clear();
  points_.shrink_to_fit();
}

void CurvePoints::AddToStretch(const Point& point) {
  const double span = base::ToSeconds(end_ - start_);
  const double share =
      span > 0 ? base::ToSeconds(std::clamp(point.time, start_, end_) - start_) / span : 0;
  const auto index = static_cast<std::size_t>(share * static_cast<double>(stretches_.size()));
  TimeBin& stretch = stretches_[std::min(index, stretches_.size() - 1)];
  const bool is_first = stretch.samples++ == 0;
  const bool is_finite = std::isfinite(point.value);
  if (is_first || (is_finite && stretch.finite == 0)) {
    stretch.least = stretch.greatest = point;
  } else if (is_finite) {
    if (point.value < stretch.least.value) stretch.least = point;
    if (point.value > stretch.greatest.value) stretch.greatest = point;
  }
  if (is_finite) ++stretch.finite;
}

std::vector<Point> CurvePoints::Points() const {
  std::vector<Point> points = points_;
  for (const TimeBin& stretch : stretches_) {
    if (stretch.samples == 0) continue;
    points.push_back(stretch.least);
    if (stretch.greatest.time != stretch.least.time) points.push_back(stretch.greatest);
  }
  std::stable_sort(points.begin(), points.end(),
                   [](const Point& a, const Point& b) { return a.time < b.time; });
  return points;
}

}  // namespace gsv::gateway::curves
