// A laser scanner: ranges over a fan, or several fans above each other, of beams.
//
// Frame       sensor frame: a beam at azimuth a (about z, counter-clockwise from x) and elevation e
//             (upwards) points to (cos e cos a, cos e sin a, sin e). The robot's own body is not
//             hit.
// Reading     values: metres, by elevation from the lowest, within it by azimuth from the smallest.
//             As in REP-117 a hit nearer than range.min reads -infinity, none within range.max
//             +infinity.
// Parameters  SDFormat's, flattened. scan.horizontal.samples (360), .resolution (1: beams for each
//             sample), .min_angle (-pi), .max_angle (pi - one beam's width); scan.vertical.* the
//             same (1 sample at 0). With one beam the angle is min_angle. range.min (0.08),
//             range.max (10). noise (m), see noise.h: a bias is each beam's own, a dropout reads as
//             nothing hit, and what lies within the limits is kept there. Of range.resolution
//             nothing is made, as in Gazebo.
// Message     with one fan a sensor_msgs/LaserScan. With several a gsv_msgs/LidarScan, which holds
//             all ranges, and beside it (/ROBOT/SENSOR/points) a sensor_msgs/PointCloud2, see
//             lidar_messages.h.
#pragma once

#include "gsv/sensing/registry.h"

namespace gsv::sensing {

SensorType LidarType();

}  // namespace gsv::sensing
