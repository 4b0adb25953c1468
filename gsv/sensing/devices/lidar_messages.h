// A lidar's scan as messages. The headers and scan_time are left to the caller.
#pragma once

#include <span>

#include "gsv/geometry/vector3.h"
#include "gsv/messages/gsv_msgs.h"
#include "gsv/messages/sensor_msgs.h"
#include "gsv/sensing/devices/lidar_settings.h"

namespace gsv::sensing {

// `ranges`: row by row from the lowest, in m.
void Write(const LidarSettings& settings, std::span<const double> ranges,
           messages::sensor_msgs::LaserScan& scan);
void Write(const LidarSettings& settings, std::span<const double> ranges,
           messages::gsv_msgs::LidarScan& scan);

// A point for each beam in the sensor's frame (fields x, y, z in m as float32, and ring, the row
// from the lowest, as uint16), ordered by rows; NaN where nothing was measured. `directions` has
// unit vectors, as many as `ranges`.
messages::sensor_msgs::PointCloud2 PointsOf(std::span<const geometry::Vector3> directions, int rows,
                                            std::span<const double> ranges);

}  // namespace gsv::sensing
