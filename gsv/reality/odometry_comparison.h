// Compares the odometry of a robot, or its commands, with its true motion.
#pragma once

#include <vector>

#include "gsv/reality/logs/log.h"
#include "gsv/sensing/devices/odometry_drift.h"

namespace gsv::reality {

// Returns the estimated path of the robot. If the log contains poses from odometry, returns these.
// Otherwise, computes the path from `start` on by exact arcs: from the wheels (whose distance is
// `wheel_distance`, m) or, if the log has no wheel readings, from the commands.
std::vector<TimedPose> ReckonedPath(const Log& log, double wheel_distance, TimedPose start = {});

// The estimated ("reckoned") and the true motion in a time window: the length of the displacement,
// and the rotation. Each window starts where the previous one ends.
struct MotionWindow {
  double reckoned_way = 0, reckoned_turn = 0;  // length of the chord, m; rotation, rad
  double true_way = 0, true_turn = 0;
  // Distance travelled (m) and sum of all rotations (rad) between the true poses of the window.
  double metres = 0, radians = 0;
};
std::vector<MotionWindow> Windows(const std::vector<TimedPose>& reckoned,
                                  const std::vector<TimedPose>& truth, double seconds);

// Statistics of many windows: the ratios of true to estimated distance and rotation, by least
// squares, and the standard deviations of the residuals (m, rad).
struct MotionStatistics {
  double way_ratio = 1, turn_ratio = 1;
  double way_scatter = 0, turn_scatter = 0;  // standard deviations of the residuals, m and rad
  std::vector<double> way_residuals, turn_residuals;  // one per window, m and rad
};
MotionStatistics StatisticsOf(const std::vector<MotionWindow>& windows);

// Simulates GSV's odometer with its error model (odometry_drift.h) along the true poses. Returns
// the poses that the odometer reports, one for each half second.
std::vector<TimedPose> SimulatedOdometry(const std::vector<TimedPose>& truth,
                                         const sensing::OdometryDrift& drift, std::uint64_t seed);

// Returns the drift parameters with which simulated windows have the same statistics as `windows`.
sensing::OdometryDrift FitDrift(const std::vector<MotionWindow>& windows);

}  // namespace gsv::reality
