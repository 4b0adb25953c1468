// A laser scanner: it measures ranges along a fan of beams, or along several fans above each other.
//
// Frame       sensor frame: a beam at azimuth a (about z, counter-clockwise from x) and elevation e
//             (upwards) points to (cos e cos a, cos e sin a, sin e). The robot's own body is not
//             hit.
// Reading     ranges in metres, by elevation from the lowest row, and within a row by azimuth from
//             the smallest. As in REP-117, a hit nearer than range.min reads -infinity, and no hit
//             within range.max reads +infinity.
// Parameters  SDFormat's, flattened. scan.horizontal.samples (360), .resolution (1: beams per
//             sample), .min_angle (-pi), .max_angle (pi minus the width of one beam);
//             scan.vertical.* likewise (1 sample at 0). A single beam has min_angle. range.min
//             (0.08), range.max (10). noise (m), see noise.h: each beam has its own bias, a dropout
//             reads as no hit, and noise does not move a range beyond the limits. range.resolution
//             has no effect, as in Gazebo. intensity_scale (0), intensity_range (0: any), see
//             below.
// Intensity   with an intensity_scale above 0, the reading has after all ranges an intensity for
//             each beam: intensity_scale × reflectance × cosine of the angle of incidence
//             (Lambert's law), and 0 without an echo. Without an intensity_range the device
//             compensates for the distance. With one, the intensity falls as (intensity_range /
//             distance)²: a surface that is larger than the beam (Höfle and Pfeifer, ISPRS Journal
//             of Photogrammetry and Remote Sensing 62 (2007)). The reflectance follows from the
//             colour (rays/echo.h).
// Message     sensor_msgs/LaserScan for one fan, with its intensities. For several fans
//             gsv_msgs/LidarScan, which has all ranges, and in addition (/ROBOT/SENSOR/points) a
//             sensor_msgs/PointCloud2, see lidar_messages.h.
#pragma once

#include "gsv/sensing/registry.h"

namespace gsv::sensing {

SensorType LidarType();

}  // namespace gsv::sensing
