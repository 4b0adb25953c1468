// Compares the odometry of a robot, or its commands, with its true motion.
#pragma once

#include <vector>

#include "gsv/reality/logs/log.h"
#include "gsv/sensing/devices/odometry_drift.h"

namespace gsv::reality {

// The path that the log's odometry, wheels (`wheel_distance`, m, lies between them) or commands make
// by exact arcs, from the origin on; the first of them that there is. `start` is its first pose.
std::vector<TimedPose> ReckonedPath(const Log& log, double wheel_distance, TimedPose start = {});

// The way within a window of time: along and across the heading at its start, and the turn; reckoned
// and true. Windows follow each other.
struct MotionWindow {
  double reckoned_way = 0, reckoned_turn = 0;  // chord, m; rad
  double true_way = 0, true_turn = 0;
  double metres = 0, radians = 0;  // driven and turned on the way, by the truth
};
std::vector<MotionWindow> Windows(const std::vector<TimedPose>& reckoned,
                                  const std::vector<TimedPose>& truth, double seconds);

// Statistics of windows: true over reckoned way and turn, by least squares, and the deviations of
// the residuals of a window (m, rad).
struct MotionStatistics {
  double way_ratio = 1, turn_ratio = 1;
  double way_scatter = 0, turn_scatter = 0;
  std::vector<double> way_residuals, turn_residuals;
};
MotionStatistics StatisticsOf(const std::vector<MotionWindow>& windows);

// The path that the error model of GSV's odometer (odometry_drift.h) makes of the truth, taken every
// half second.
std::vector<TimedPose> SimulatedOdometry(const std::vector<TimedPose>& truth,
                                         const sensing::OdometryDrift& drift, std::uint64_t seed);

// The drift that makes windows of these statistics.
sensing::OdometryDrift FitDrift(const std::vector<MotionWindow>& windows);

}  // namespace gsv::reality
