// Stores the log of a real robot, in one structure for all formats.
//
// Units   metres, radians, seconds. Times are relative to the first time in the log.
// Frames  `truth`, `odometry`: world_from_base and odom_from_base. Angles of beams are relative to
//         the base's x axis, counter-clockwise.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "gsv/base/error.h"
#include "gsv/geometry/vector3.h"

namespace gsv::reality {

// A pose on the ground and its time: s, m, rad.
struct TimedPose {
  double time = 0;
  double x = 0, y = 0, yaw = 0;
};

// A velocity command.
struct TimedTwist {
  double time = 0;
  double linear = 0, angular = 0;  // forward velocity and turning rate
};

// The distance that each wheel has travelled since the start of the log.
struct TimedWheels {
  double time = 0;
  double left = 0, right = 0;  // m
};

// The ranges of all beams, or of all sonars of a ring, at one instant. Infinite means no echo.
struct RangeScan {
  double time = 0;
  std::vector<double> ranges;
  std::optional<TimedPose> base;  // pose of the robot in the log's odometry or truth, if any
};

// One measured distance to a radio anchor, and the distance by the reference system.
struct RadioRange {
  double time = 0;
  int anchor = 0;                      // number of the anchor in the log
  double measured = 0, reference = 0;  // distance by the radio, and by the reference system
  double anchor_x = 0, anchor_y = 0;   // position of the anchor
};

// The data of one drive of a real robot. Series that the log lacks are empty.
struct Log {
  // Poses from a reference system, such as motion capture or an overhead camera.
  std::vector<TimedPose> truth;
  bool truth_has_yaw = true;         // false if the reference system measures only positions
  std::vector<TimedPose> odometry;   // poses from the robot's own odometry
  std::vector<TimedTwist> commands;  // commands to the robot's drive
  std::vector<TimedWheels> wheels;   // readings of the wheel encoders
  std::vector<double> beam_angles;   // direction of each beam of a scan
  double max_range = 0;              // maximum range; a reading of this value means no echo
  double sensor_forward = 0;         // distance from the base to the sensor along x, m
  bool is_sonar = false;             // whether the beams are cones of sound
  std::vector<RangeScan> scans;      // each scan has beam_angles.size() ranges
  std::vector<RadioRange> radio;     // ranges to radio anchors
  // The time of the last entry of all series, s.
  double duration() const;
};

// Returns the pose at `time`, interpolated between two of `poses`, which must be ordered by time.
// Returns nullopt before the first and after the last pose, and between poses that are more than
// `max_gap` seconds apart.
std::optional<TimedPose> PoseAt(const std::vector<TimedPose>& poses, double time,
                                double max_gap = 1);

// Returns the equivalent angle in [-pi, pi].
double WrappedAngle(double angle);

}  // namespace gsv::reality
