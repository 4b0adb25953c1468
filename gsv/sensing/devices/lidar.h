// A laser scanner: it measures ranges along a fan of beams, or along several fans above each other.
//
// Frame       sensor frame: a beam at azimuth a (about z, counter-clockwise from x) and elevation e
//             (upwards) points to (cos e cos a, cos e sin a, sin e). The robot's own body is not
//             hit.
// Reading     ranges in metres. Rows are ordered by elevation, from the lowest. Within a row, beams
//             are ordered by azimuth, from the smallest. As in REP-117, a hit nearer than range.min
//             reads -infinity, and a beam without a hit within range.max reads +infinity.
// Parameters  the elements of SDFormat's <lidar> as paths (with their default values)
//   scan.horizontal.samples (360), .resolution (1)   their product is the number of beams
//   scan.horizontal.min_angle (-pi), .max_angle (179 degrees)
//   scan.vertical.*         the same parameters for the rows (1 sample at 0); if there is only one
//                           row, it is at min_angle
//   range.min (0.08 m), range.max (10 m); range.resolution has no effect, as in Gazebo
//   noise (m)               see noise.h. Each beam has its own bias. A dropout reads as no hit.
//                           Noise does not move a range beyond range.max. White noise alone does
//                           not move it below range.min.
//   intensity_scale (0), intensity_range (0 m)   see below
// Intensity   if intensity_scale is above 0, the reading has the intensities of all beams after the
//             ranges. An intensity is intensity_scale × reflectance × cosine of the angle of
//             incidence (Lambert's law), or 0 without an echo. If intensity_range is 0, the device
//             compensates for the distance. Otherwise the intensity is multiplied by
//             (intensity_range / distance)², as for a surface that is larger than the beam (Höfle
//             and Pfeifer, ISPRS Journal of Photogrammetry and Remote Sensing 62 (2007)). The
//             reflectance follows from the colour (rays/echo.h).
// Message     sensor_msgs/LaserScan for one fan, with its intensities. For several fans there are
//             two messages: gsv_msgs/LidarScan with all ranges, and a sensor_msgs/PointCloud2 on
//             the topic /ROBOT/SENSOR/points, see lidar_messages.h.
#pragma once

#include "gsv/sensing/registry.h"

namespace gsv::sensing {

SensorType LidarType();

}  // namespace gsv::sensing
