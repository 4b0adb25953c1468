// Estimates the poses of a robot with a lidar in a world, from its scans and its odometry.
//
// Method  a likelihood field (Thrun, Burgard, Fox, "Probabilistic Robotics", section 6.4): the
//         distance from each cell to the nearest occupied cell. The search for the first pose
//         covers the whole map, and uses several scans along the first metres of odometry. The
//         search for each later pose covers only the neighbourhood of the previous pose.
// Errors  kInvalidArgument if no pose matches the scans.
#pragma once

#include <optional>
#include <vector>

#include "gsv/base/error.h"
#include "gsv/reality/logs/log.h"
#include "gsv/reality/maps/occupancy_map.h"

namespace gsv::reality {

// Stores the distance from each cell of a map to the nearest occupied cell, and rates how well a
// scan fits the map.
class LikelihoodField {
 public:
  explicit LikelihoodField(const OccupancyMap& map);

  // Returns the score of a scan in [0, 1]: the mean weight of its finite ranges. The weight is 1
  // for a range that ends on an occupied cell, and falls to 0 with the distance from the nearest
  // one (a Gaussian). Uses every `stride`th beam.
  double Score(const Log& log, const RangeScan& scan, const TimedPose& base,
               std::size_t stride) const;
  // Returns the pose with the best score near `guess`. The local search starts with steps of
  // `reach` m and `reach` / 2 rad, and halves the steps repeatedly.
  TimedPose Refined(const Log& log, const RangeScan& scan, TimedPose guess, double reach) const;

  const OccupancyMap& map() const { return map_; }

 private:
  // Returns the distance from a point of the world to the nearest occupied cell: m, at most 1.
  double DistanceAt(double x, double y) const;

  OccupancyMap map_;
  double deviation_ = 0.1;        // standard deviation of the score's Gaussian, m
  std::vector<float> distances_;  // for each cell of the map; m, at most 1
};

// Returns the poses, in the world, of every `stride`th scan of log.scans. `start` is the pose of
// the first scan, if known.
base::Result<std::vector<TimedPose>> Localize(const Log& log, const LikelihoodField& field,
                                              const std::optional<TimedPose>& start,
                                              std::size_t stride);

}  // namespace gsv::reality
