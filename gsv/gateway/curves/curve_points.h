// A curve in bounded memory: all samples while they fit; then the minimum and maximum of equal time
// bins, each at its own instant. So no spike is lost, and every point is a sample.
#pragma once

#include <cstddef>
#include <vector>

#include "gsv/base/sim_time.h"

namespace gsv::gateway::curves {

struct Point {
  base::SimTime time{};
  double value = 0;  // may be infinite or NaN, such as a missing echo

  friend bool operator==(const Point&, const Point&) = default;
};

class CurvePoints {
 public:
  // Samples from `start` to `end`; at most `most` points are kept, >= 2.
  CurvePoints(base::SimTime start, base::SimTime end, std::size_t most);

  // A sample outside of the range counts at its nearer end.
  void Add(base::SimTime time, double value);

  std::size_t samples() const { return samples_; }      // added so far
  bool is_whole() const { return stretches_.empty(); }  // whether every sample is a point

  // The points by time. A bin without finite samples has one point, its first.
  std::vector<Point> Points() const;

 private:
  struct TimeBin {
    std::size_t finite = 0, samples = 0;
    Point least, greatest;  // the first sample, while none is finite
  };

  void AddToStretch(const Point& point);

  const base::SimTime start_, end_;
  const std::size_t most_;
  std::size_t samples_ = 0;
  std::vector<Point> points_;
  std::vector<TimeBin> stretches_;  // empty: points_ holds all
};

}  // namespace gsv::gateway::curves
