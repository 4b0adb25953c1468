// CurvePoints stores the points of a curve in bounded memory. It keeps all samples while they fit.
// Then it divides the time range into equal bins, and keeps the minimum and the maximum of each bin
// with their times. So no peak is lost.
#pragma once

#include <cstddef>
#include <vector>

#include "gsv/base/sim_time.h"

namespace gsv::gateway::curves {

// A point of a curve: a value at a simulated time.
struct Point {
  base::SimTime time{};
  double value = 0;  // may be infinite or NaN, for example a range without an echo

  friend bool operator==(const Point&, const Point&) = default;
};

// Stores the points of a curve in bounded memory.
class CurvePoints {
 public:
  // `start` and `end` are the range of the samples' times. Keeps at most `max_points`, >= 2.
  CurvePoints(base::SimTime start, base::SimTime end, std::size_t max_points);

  // Adds a sample. A sample outside of the time range is assigned to the nearer end of the range.
  void Add(base::SimTime time, double value);

  std::size_t samples() const { return samples_; }  // number of samples so far
  bool is_whole() const { return bins_.empty(); }   // whether every sample is a point

  // Returns the points ordered by time. A bin without finite samples has one point: its first
  // sample.
  std::vector<Point> Points() const;

 private:
  // The samples in one part of the time range.
  struct TimeBin {
    std::size_t finite = 0, samples = 0;  // numbers of finite samples and of all samples
    Point min, max;                       // both equal the first sample until a sample is finite
  };

  // Adds a sample to the bin of its time.
  void AddToBin(const Point& point);

  const base::SimTime start_, end_;  // the time range of all bins
  const std::size_t max_points_;
  std::size_t samples_ = 0;
  std::vector<Point> points_;  // all samples, while they fit
  std::vector<TimeBin> bins_;  // empty while points_ holds all samples
};

}  // namespace gsv::gateway::curves
