// Compares the odometry of a robot, or its commands, with its true motion.
#pragma once

#include <vector>

#include "gsv/reality/logs/log.h"
#include "gsv/sensing/devices/odometry_drift.h"

namespace gsv::reality {

// Returns the path of the robot from the origin on, by exact arcs. It is computed from odometry,
// from the wheels (whose distance is `wheel_distance`, m), or from commands: the first of these
// that the log has. `start` is the first pose.
std::vector<TimedPose> ReckonedPath(const Log& log, double wheel_distance, TimedPose start = {});

// The motion within a window of time, estimated and true: the displacement along and across the
// heading at its start, and the rotation. Windows are consecutive.
struct MotionWindow {
  double reckoned_way = 0, reckoned_turn = 0;  // length of the chord, m; rotation, rad
  double true_way = 0, true_turn = 0;
  double metres = 0, radians = 0;  // distance and rotation according to the true poses, m and rad
};
std::vector<MotionWindow> Windows(const std::vector<TimedPose>& reckoned,
                                  const std::vector<TimedPose>& truth, double seconds);

// Statistics of windows: the ratios of true to estimated distance and rotation, by least squares,
// and the standard deviations of the residuals of a window (m, rad).
struct MotionStatistics {
  double way_ratio = 1, turn_ratio = 1;
  double way_scatter = 0, turn_scatter = 0;
  std::vector<double> way_residuals, turn_residuals;
};
MotionStatistics StatisticsOf(const std::vector<MotionWindow>& windows);

// Returns the path that the error model of GSV's odometer (odometry_drift.h) computes from the true
// poses, which are taken every half second.
std::vector<TimedPose> SimulatedOdometry(const std::vector<TimedPose>& truth,
                                         const sensing::OdometryDrift& drift, std::uint64_t seed);

// Returns the parameters of the drift that gives windows with these statistics.
sensing::OdometryDrift FitDrift(const std::vector<MotionWindow>& windows);

}  // namespace gsv::reality
